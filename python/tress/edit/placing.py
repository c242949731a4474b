"""Strips set on a surface: their shape stays, their root comes to lie on the nearest triangle."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tress.kernel.geom import closest_points
from tress.model.attachment import Attachment
from tress.model.mesh import Mesh
from tress.model.root_frames import RootFrames, triangle_frames

Array = np.ndarray[Any, Any]


def nearest_frames(mesh: Mesh, places: Array) -> tuple[Array, Array, RootFrames]:
    """Triangle (N,), barycentric coordinates (N, 3) and frames of the points of a mesh nearest to `places` (N, 3)."""
    found = closest_points(mesh.positions, triangles=mesh.triangles, queries=places)
    frames = triangle_frames(mesh, triangle=found.triangle, barycentric=found.barycentric)
    return found.triangle, found.barycentric, frames


def least_turn(source: Array, target: Array) -> Array:
    """(3, 3) smallest rotation that takes one unit vector to another; half a turn about any axis where they oppose."""
    cosine, axis = float(source @ target), np.cross(source, target)
    if cosine < -1 + 1e-12:
        side = np.cross(source, np.eye(3)[np.argmin(np.abs(source))])
        side /= np.linalg.norm(side)
        return 2 * np.outer(side, side) - np.eye(3)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + cross + cross @ cross / (1 + cosine)


def slid(mesh: Mesh, roots: Sequence[Attachment], frames: RootFrames, shift_m: Array) -> list[tuple[Attachment, Array]]:
    """Roots slid over their surface by (N, 2) metres along the x and y axes of their frames: the new root, and the
    rotation (3, 3) that takes vectors from the old frame to the new one, such that strips turn with the surface alone.
    """
    offsets = np.array([root.offset for root in roots])
    bases = frames.origins - np.einsum("nij,nj->ni", frames.axes, offsets)
    targets = bases + np.einsum("nij,nj->ni", frames.axes[:, :, :2], shift_m)
    triangle, barycentric, found = nearest_frames(mesh, targets)
    result = []
    for index, root in enumerate(roots):
        old, new = frames.axes[index], found.axes[index]
        rotation = new.T @ least_turn(old[:, 2], new[:, 2]) @ old
        placed = Attachment(
            surface=root.surface,
            triangle=int(triangle[index]),
            barycentric=barycentric[index] / barycentric[index].sum(),
            offset=rotation @ root.offset,
        )
        result.append((placed, rotation))
    return result
