"""The frames in which attached strips keep their control points."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.model.attachment import Attachment, surface_mesh
from tress.model.document import Document
from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]

MIN_AREA_M2 = 1e-16


@dataclass(frozen=True, eq=False)
class RootFrames:
    """S rigid frames: `axes` (S, 3, 3) float64 with x, y, z as columns, `origins` (S, 3) float64 metres, in the head
    frame."""

    axes: Array
    origins: Array

    def points_in_head(self, points_in_root: Array, *, strip: Array) -> Array:
        """(N, 3) points of the frames `strip` (N,) in the head frame."""
        return self.vectors_in_head(points_in_root, strip=strip) + self.origins[strip]

    def vectors_in_head(self, vectors_in_root: Array, *, strip: Array) -> Array:
        """(N, 3) directions in the head frame."""
        return np.einsum("nij,nj->ni", self.axes[strip], vectors_in_root)

    def points_in_root(self, points_in_head: Array, *, strip: Array) -> Array:
        """(N, 3) points of the head frame in the frames `strip` (N,)."""
        return self.vectors_in_root(points_in_head - self.origins[strip], strip=strip)

    def vectors_in_root(self, vectors_in_head: Array, *, strip: Array) -> Array:
        """(N, 3) directions in the frames `strip` (N,)."""
        return np.einsum("nji,nj->ni", self.axes[strip], vectors_in_head)


def root_frames(document: Document, roots: Sequence[Attachment | None]) -> RootFrames:
    """The frames of roots on the surfaces of a document; the head frame itself for None.

    Raises `InputError` where a triangle has no area.
    """
    axes, origins = np.tile(np.eye(3), (len(roots), 1, 1)), np.zeros((len(roots), 3))
    for surface in sorted({root.surface for root in roots if root is not None}):
        chosen = [index for index, root in enumerate(roots) if root is not None and root.surface == surface]
        held = [root for root in roots if root is not None and root.surface == surface]
        mesh = surface_mesh(document, surface, where="A strip")
        triangle = np.array([root.triangle for root in held])
        found = triangle_frames(mesh, triangle=triangle, barycentric=np.array([root.barycentric for root in held]))
        offset = np.array([root.offset for root in held])
        axes[chosen] = found.axes
        origins[chosen] = found.points_in_head(offset, strip=np.arange(len(held)))
    return RootFrames(axes, origins)


def triangle_frames(mesh: Mesh, *, triangle: Array, barycentric: Array) -> RootFrames:
    """The frames of S places on triangles: z the outward normal, x along the first edge.

    Raises `InputError` where a triangle has no area.
    """
    corners = mesh.positions.astype(np.float64)[mesh.triangles[triangle]]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(first, second)
    doubled_area = np.linalg.norm(normal, axis=1, keepdims=True)
    if len(triangle) and doubled_area.min() < 2 * MIN_AREA_M2:
        flat = int(triangle[int(np.argmin(doubled_area))])
        raise InputError(f"Triangle {flat} has no area; a strip needs one with area as its root.")
    z = normal / doubled_area
    x = first / np.linalg.norm(first, axis=1, keepdims=True)
    origins = np.einsum("sk,skd->sd", barycentric, corners)
    return RootFrames(np.stack([x, np.cross(z, x), z], axis=2), origins)
