"""The outside of a head that hair is laid over, in polar coordinates about a pole."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull

from tress.kernel.geom import ray_hits
from tress.methods.strips.bald_document import HEAD
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]

FAR_M = 1.0
BROW_M = 0.01
"""How far above the eyes the forehead begins."""


@dataclass(frozen=True, eq=False)
class Skull:
    """The convex hull of scalp, ears and forehead, `positions` and `triangles`, and the `head` itself.

    Hair lies on the hull: it goes over ears and nape without following every fold. Directions are given by `azimuth`
    (radians; 0 forwards, a quarter turn to the head's left) and `polar` angle from a pole (3,), by default the whorl of
    hair at the back of the crown.
    """

    positions: Array
    triangles: Array
    head: Mesh

    @cached_property
    def height_m(self) -> float:
        """From chin to crown: what lengths are measured by."""
        face = self.head.positions[self.head.vertex_attributes["face"] > 0.5]
        return float(self.head.positions[:, 1].max() - face[:, 1].min())

    def points(self, azimuth: Any, polar: Any, *, pole: Any = (0.0, 0.9, -0.44)) -> Array:
        """(..., 3) points of the hull in directions `azimuth` and `polar` (radians), broadcast together."""
        return self._outermost(directions(azimuth, polar, pole=pole), self.positions, self.triangles)[0]

    def scalp(self, azimuth: Any, polar: Any, *, pole: Any = (0.0, 0.9, -0.44)) -> tuple[Array, Array]:
        """(..., 3) points of the head itself, and (...) how far they are scalp, 0 to 1."""
        way = directions(azimuth, polar, pole=pole)
        points, triangle, barycentric = self._outermost(way, self.head.positions, self.head.triangles)
        mask = self.head.vertex_attributes["scalp"][self.head.triangles[triangle]]
        return points, (mask * barycentric).sum(axis=-1)

    def hairline(self, azimuth: Any, *, pole: Any = (0.0, 0.9, -0.44), steps: int = 120) -> Array:
        """(V,) polar angle (radians) at which the scalp ends on the way down from the pole at every azimuth."""
        polar = np.linspace(0, 0.95 * np.pi, steps)
        mask = self.scalp(np.asarray(azimuth)[:, None], polar, pole=pole)[1]
        return polar[steps - 1 - np.argmax(mask[:, ::-1] > 0.5, axis=1)]

    def _outermost(self, way: Array, positions: Array, triangles: Array) -> tuple[Array, Array, Array]:
        flat = way.reshape(-1, 3)
        hits = ray_hits(positions, triangles=triangles, origins=FAR_M * flat, directions=-flat, limit=FAR_M)
        distance = np.where(hits.triangle >= 0, FAR_M - np.where(hits.triangle >= 0, hits.t, 0), 0)
        shape = way.shape[:-1]
        points = (distance[:, None] * flat).reshape(way.shape)
        return points, hits.triangle.reshape(shape), hits.barycentric.reshape(*shape, 3)


def skull_of(document: Document) -> Skull:
    """The skull of the document's head. Raises `InputError` where there is none."""
    head = surface_mesh(document, HEAD, where="A preset")
    masks = head.vertex_attributes
    brow = head.positions[masks["eyes"] > 0.5][:, 1].max() + BROW_M
    chosen = (masks["scalp"] > 0.5) | (masks["ears"] > 0.5) | ((masks["face"] > 0.5) & (head.positions[:, 1] > brow))
    positions = head.positions[chosen].astype(np.float64)
    hull = ConvexHull(positions)
    corners = positions[hull.simplices]
    facing = np.einsum(
        "fi,fi->f", np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), corners[:, 0]
    )
    triangles = np.where((facing > 0)[:, None], hull.simplices, hull.simplices[:, ::-1])
    return Skull(positions, triangles, head)


def directions(azimuth: Any, polar: Any, *, pole: Any) -> Array:
    """(..., 3) unit vectors at angles from a pole (3,), of which azimuth 0 is the way to the front, or, from a pole at
    the front, upwards."""
    up = np.asarray(pole, float) / np.linalg.norm(pole)
    ahead = np.array([0.0, 0.0, 1.0]) if abs(up[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
    front = ahead - (ahead @ up) * up
    front /= np.linalg.norm(front)
    left = np.cross(up, front)
    azimuth, polar = np.broadcast_arrays(np.asarray(azimuth, float), np.asarray(polar, float))
    level = np.cos(azimuth)[..., None] * front + np.sin(azimuth)[..., None] * left
    return np.cos(polar)[..., None] * up + np.sin(polar)[..., None] * level
