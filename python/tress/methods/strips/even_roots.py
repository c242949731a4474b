"""Roots for strips: evenly spread over a part of the scalp."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import KDTree

from tress.base.errors import InputError
from tress.head.scalp import scalp_roots
from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]
Where = Callable[[Array], Array]
"""Which (N,) bool of places (N, 3)."""

CANDIDATES = 12  # for each root
OFF_EARS_M = 0.014


@dataclass(frozen=True, eq=False)
class EvenRoots:
    """N places on a surface, as `attach` takes them: `triangles` (N,) int32 and `barycentric` (N, 3) float64; and the
    `points` (N, 3) there."""

    triangles: Array
    barycentric: Array
    points: Array

    def where(self, chosen: Array) -> "EvenRoots":
        """Those that are `chosen` (N,) bool."""
        return EvenRoots(self.triangles[chosen], self.barycentric[chosen], self.points[chosen])


def even_roots(
    mesh: Mesh,
    *,
    count: int,
    seed: int,
    where: Where | None = None,
    least_scalp: float = 0.5,
    most_scalp: float = 1.0,
) -> EvenRoots:
    """`count` places on the scalp of a mesh, each as far from the others as may be.

    `where(points)` (N,) bool chooses among places (N, 3), `least_scalp` keeps them off the rim of the mask, and
    `most_scalp` on it. Places
    right at the ears are left out, where strips would be crushed. The same seed gives the same places. Raises
    `InputError` where the mesh has no mask `scalp` or nothing is chosen.
    """
    scalp = mesh.vertex_attributes.get("scalp")
    if scalp is None:
        raise InputError("The mesh has no mask `scalp`; roots need one.")
    found = scalp_roots(
        mesh.positions, triangles=mesh.triangles, scalp=scalp, count=CANDIDATES * max(count, 40), seed=seed
    )
    share = np.einsum("nk,nk->n", found.barycentric, scalp[mesh.triangles[found.triangle]])
    allowed = (share >= least_scalp) & (share <= most_scalp + 1e-6)
    if where is not None:
        allowed &= where(found.positions)
    allowed &= _off_the_ears(mesh, found.positions)
    if not allowed.any():
        raise InputError("No place on the scalp was chosen; a wider choice was expected.")
    index = np.flatnonzero(allowed)
    index = index[_far_apart(found.positions[index], count)]
    weights = found.barycentric[index].astype(np.float64)
    return EvenRoots(found.triangle[index], weights / weights.sum(axis=1, keepdims=True), found.positions[index])


def _off_the_ears(mesh: Mesh, points: Array) -> Array:
    ears = mesh.vertex_attributes.get("ears")
    if ears is None or not (ears > 0.5).any():
        return np.ones(len(points), bool)
    return KDTree(mesh.positions[ears > 0.5]).query(points)[0] >= OFF_EARS_M


def _far_apart(points: Array, count: int) -> Array:
    """Up to `count` of the points, each time the one that is farthest from those before it."""
    chosen = [0]
    gap = np.linalg.norm(points - points[0], axis=1)
    while len(chosen) < min(count, len(points)):
        chosen.append(int(np.argmax(gap)))
        gap = np.minimum(gap, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return np.array(chosen)


def above_the_ears(points: Array) -> Array:
    """(N,) bool: not at the temples beside and below the ears, over which hair from above falls anyway."""
    return (points[:, 1] > 0.02) | (points[:, 2] < -0.045)
