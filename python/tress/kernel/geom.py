"""Queries of triangle meshes: closest points, signed distances, rays. All run on every core.

Meshes come as `positions` (V, 3), metres, and `triangles` (F, 3), counter-clockwise seen from outside. Each call builds
a bounding volume hierarchy (about 1 ms for 1,000 triangles), so ask many queries at once. Every function raises
`InputError` for wrong shapes, numbers that are not finite, triangles that name no vertex, and a mesh without triangles.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Closest:
    """Closest points of Q queries.

    `triangle` (Q,) int32, `barycentric` (Q, 3) float64, `distance` (Q,) float64 metres, negative where it is signed and
    the query lies inside.
    """

    triangle: Array
    barycentric: Array
    distance: Array

    def points(self, positions: Array, *, triangles: Array) -> Array:
        """The closest points themselves, (Q, 3); also any other attribute (V, ...) of the vertices there."""
        return barycentric_values(positions, triangles=triangles, triangle=self.triangle, barycentric=self.barycentric)


@dataclass(frozen=True, eq=False)
class Hits:
    """First hits of Q rays, at `origin + t * direction`.

    `triangle` (Q,) int32, -1 for a miss; `barycentric` (Q, 3) float64; `t` (Q,) float64, infinite for a miss.
    """

    triangle: Array
    barycentric: Array
    t: Array


def closest_points(positions: Array, *, triangles: Array, queries: Array) -> Closest:
    """The closest point of the mesh for every query (Q, 3).

    >>> corner = np.eye(3)
    >>> found = closest_points(corner, triangles=[[0, 1, 2]], queries=[[1.0, 1.0, 1.0]])
    >>> np.round(found.points(corner, triangles=np.array([[0, 1, 2]])), 6).tolist()
    [[0.333333, 0.333333, 0.333333]]
    """
    return Closest(*_answer(_core.geom_closest_points, positions, triangles, _points(queries, "queries")))


def signed_distances(positions: Array, *, triangles: Array, queries: Array) -> Closest:
    """Closest points with distances that are negative inside.

    Inside is where the generalised winding number exceeds 1/2, so holes (the neck of a head) are closed by a gentle
    cap; next to a hole the distance, which is still that of the surface, jumps in sign.

    Source: Jacobson et al. 2013, Barill et al. 2018.
    """
    return Closest(*_answer(_core.geom_signed_distances, positions, triangles, _points(queries, "queries")))


def winding_numbers(positions: Array, *, triangles: Array, queries: Array) -> Array:
    """Generalised winding number (Q,) float64 of every query (Q, 3): 1 inside, 0 outside, within 0.02."""
    return _answer(_core.geom_winding_numbers, positions, triangles, _points(queries, "queries"))


def ray_hits(positions: Array, *, triangles: Array, origins: Array, directions: Array, limit: float = np.inf) -> Hits:
    """First hit of every ray, on either side of the surface.

    `origins` and `directions` are (Q, 3); a direction may have any length but 0, and is the unit of `t` and `limit`.

    >>> ray_hits(np.eye(3), triangles=[[0, 1, 2]], origins=[[0, 0, 0]], directions=[[1, 1, 1]]).t.round(6).tolist()
    [0.333333]
    """
    return Hits(*_answer(_core.geom_first_hits, positions, triangles, *_rays(origins, directions), float(limit)))


def rays_blocked(
    positions: Array, *, triangles: Array, origins: Array, directions: Array, limit: float = np.inf
) -> Array:
    """(Q,) bool: whether each ray hits anything within `limit` times its direction. Faster than `ray_hits`."""
    return _answer(_core.geom_any_hits, positions, triangles, *_rays(origins, directions), float(limit))


def barycentric_values(values: Array, *, triangles: Array, triangle: Array, barycentric: Array) -> Array:
    """Attribute `values` (V, ...) of vertices at points given by `triangle` (Q,) and `barycentric` (Q, 3): (Q, ...)."""
    at_corners = np.asarray(values)[np.asarray(triangles)[triangle]]
    return np.einsum("qc,qc...->q...", np.asarray(barycentric, np.result_type(at_corners, np.float32)), at_corners)


def _answer(function: Any, positions: Array, triangles: Array, *rest: Any) -> Any:
    vertices = _points(positions, "positions")
    corners = checked(triangles, name="triangles", dtype=np.uint32, shape=(None, 3))
    try:
        return function(vertices, corners, *rest)
    except ValueError as error:
        raise InputError(f"The mesh cannot be used: {error}.") from error


def _rays(origins: Array, directions: Array) -> tuple[Array, Array]:
    starts, along = _points(origins, "origins"), _points(directions, "directions")
    if starts.shape != along.shape:
        raise InputError(f"origins are {len(starts)} and directions {len(along)}; the same number was expected.")
    if not along.any(axis=1).all():
        raise InputError("A direction of length 0 was given; any other length was expected.")
    return starts, along


def _points(value: Array, name: str) -> Array:
    return checked(value, name=name, dtype=np.float64, shape=(None, 3))
