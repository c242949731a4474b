"""Which way a mesh faces, and which way hair runs over it, at its vertices."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class MeshFrames:
    """Unit vectors (V, 3) float32 at the vertices: `normal` outwards, `along` root to tip, `across` left to right."""

    normal: Array
    along: Array
    across: Array


def is_cards(mesh: Mesh) -> bool:
    """Whether the mesh is one of strips: it knows what `fraction` of a strip every vertex is, along and across."""
    return mesh.vertex_attributes.get("fraction", np.zeros(0)).shape == (len(mesh.positions), 2)


def vertex_normals(mesh: Mesh) -> Array:
    """(V, 3) float32: unit sums of the area normals of the triangles around every vertex; 0 where there are none."""
    a, b = _edges(mesh)
    return _unit_sums(mesh, np.cross(a, b))


def mesh_frames(mesh: Mesh) -> MeshFrames:
    """Frames of a mesh of strips, by the gradients of `fraction` over its triangles."""
    fraction = mesh.vertex_attributes["fraction"].astype(np.float64)[mesh.triangles]
    return MeshFrames(vertex_normals(mesh), _gradient(mesh, fraction[..., 0]), _gradient(mesh, fraction[..., 1]))


def _gradient(mesh: Mesh, corners: Array) -> Array:
    """(V, 3) float32 unit directions in which values (F, 3) at the corners grow."""
    a, b = _edges(mesh)
    normal = np.cross(a, b)
    first, second = (corners[:, i, None] - corners[:, :1] for i in (1, 2))
    return _unit_sums(mesh, first * np.cross(b, normal) + second * np.cross(normal, a))


def _edges(mesh: Mesh) -> tuple[Array, Array]:
    corners = mesh.positions[mesh.triangles].astype(np.float64)
    return corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]


def _unit_sums(mesh: Mesh, per_triangle: Array) -> Array:
    """Unit vectors of the sums over the triangles around every vertex, in one order."""
    vertex, flat = mesh.triangles.ravel(), np.repeat(per_triangle, 3, axis=0)
    sums = [np.bincount(vertex, weights=flat[:, axis], minlength=len(mesh.positions)) for axis in range(3)]
    total = np.stack(sums, axis=1)
    return (total / np.linalg.norm(total, axis=1, keepdims=True).clip(1e-30)).astype(np.float32)
