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
Demand = Callable[[Array, Array], tuple[Array, Array]]

# Even steps lead from wall to wall in the folds of ears; later ones grow.
EVEN_ROUNDS, GROWTH = 10, 0.2


@dataclass(frozen=True, eq=False)
class Pushed:
    """Control points (N, 3) afterwards, how many rounds it took, whether every point of the surface is content, and how
    far (Q,) each of them may still move and stay so, as far as that is known."""

    control_points: Array
    iterations: int
    converged: bool
    slack: Array


def pushed(
    grid: StripGrid,
    control_points: Array,
    demand: Demand,
    *,
    max_iterations: int,
    held: Array | None = None,
    slack: Array | None = None,
) -> Pushed:
    """Moves control points (N, 3) until `demand` is zero.

    `demand(points, rows)` says of the points (M, 3), which are the rows `rows` of the grid, how far they must move,
    (M, 3), and how far each of those that need not may move, (M,), before it must be asked again; `slack` (Q,) says the
    same of all points to begin with. Control points that are `held` (N,) bool stay, and points of the surface that hang
    on them for half or more are not asked.
    """
    points, weights = np.array(control_points), grid.weights
    if held is not None:
        weights = csr_array(weights * ~held)
        weights.eliminate_zeros()
    able = weights.sum(axis=1) > 0.5
    slack = np.full(len(able), -1.0) if slack is None else np.array(slack)
    here, rows = grid.points(points), np.flatnonzero(able)
    for iteration in range(max_iterations + 1):
        asked = rows[slack[rows] <= 0]
        wanted, slack[asked] = demand(here[asked], asked)
        asking = wanted.any(axis=1)
        if not asking.any():
            return Pushed(points, iteration, True, slack)
        rows = np.flatnonzero(np.isin(grid.strip, np.unique(grid.strip[asked[asking]])) & able)
        if iteration < max_iterations:
            points += (1 + GROWTH * max(iteration - EVEN_ROUNDS, 0)) * _largest_share(
                weights[asked[asking]], wanted[asking], count=len(points)
            )
            moved = grid.weights[rows] @ points
            slack[rows] -= np.linalg.norm(moved - here[rows], axis=1)
            here[rows] = moved
    return Pushed(points, max_iterations, False, slack)


def _largest_share(weights: csr_array, wanted: Array, *, count: int) -> Array:
    """(N, 3) the largest motion that each control point is asked for, by points with these `weights` (M, N)."""
    row = np.repeat(np.arange(len(wanted)), np.diff(weights.indptr))
    squares = np.add.reduceat(weights.data**2, weights.indptr[:-1])
    share = weights.data / squares[row]
    order = np.argsort(share * np.linalg.norm(wanted, axis=1)[row], kind="stable")
    result = np.zeros((count, 3))
    result[weights.indices[order]] = share[order, None] * wanted[row[order]]
    return result
