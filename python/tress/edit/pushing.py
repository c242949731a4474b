"""Control points moved such that points of the surface move where they should.

Every point of the surface that must move by d asks its control points for d × w / Σ w², the smallest motion that moves
it by d; each control point does the largest that it is asked for. Where all points are pushed to the same side, each of
them moves at least about as far as it must, so a few rounds settle it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from tress.model.strip_grid import StripGrid

Array = np.ndarray[Any, Any]

# Even steps lead from wall to wall in the folds of ears; later ones grow.
EVEN_ROUNDS, GROWTH = 10, 0.2


@dataclass(frozen=True, eq=False)
class Pushed:
    """Control points (N, 3) afterwards, how many rounds it took, and whether every point of the surface is content."""

    control_points: Array
    iterations: int
    converged: bool


def pushed(
    grid: StripGrid,
    control_points: Array,
    demand: Callable[[Array, Array], Array],
    *,
    max_iterations: int,
    held: Array | None = None,
) -> Pushed:
    """Moves control points (N, 3) until `demand` is zero.

    `demand(points, rows)` says how far the points (M, 3), which are the rows `rows` of the grid, must move, (M, 3).
    Strips that are content are not asked again. Control points that are `held` (N,) bool stay, and points of the
    surface that hang on them for half or more are not asked.
    """
    points = np.array(control_points)
    weights = grid.weights
    if held is not None:
        weights = csr_array(weights * ~held)
        weights.eliminate_zeros()
    able = weights.sum(axis=1) > 0.5
    rows = np.flatnonzero(able)
    for iteration in range(max_iterations + 1):
        wanted = demand(grid.weights[rows] @ points, rows)
        asking = wanted.any(axis=1)
        if not asking.any():
            return Pushed(points, iteration, True)
        if iteration < max_iterations:
            points += (1 + GROWTH * max(iteration - EVEN_ROUNDS, 0)) * _largest_share(
                weights[rows[asking]], wanted[asking], count=len(points)
            )
        restless = np.unique(grid.strip[rows[asking]])
        rows = np.flatnonzero(np.isin(grid.strip, restless) & able)
    return Pushed(points, max_iterations, False)


def _largest_share(weights: csr_array, wanted: Array, *, count: int) -> Array:
    """(N, 3) the largest motion that each control point is asked for, by points with these `weights` (M, N)."""
    row = np.repeat(np.arange(len(wanted)), np.diff(weights.indptr))
    squares = np.add.reduceat(weights.data**2, weights.indptr[:-1])
    share = weights.data / squares[row]
    order = np.argsort(share * np.linalg.norm(wanted, axis=1)[row], kind="stable")
    result = np.zeros((count, 3))
    result[weights.indices[order]] = share[order, None] * wanted[row[order]]
    return result
