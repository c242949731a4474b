"""Normals of meshes for files."""

from typing import Any

import numpy as np

from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]


def vertex_normals(mesh: Mesh) -> Array:
    """(V, 3) float32 unit normals: those of the triangles about a vertex, weighted by area; up where there is none."""
    a, b, c = (mesh.positions[mesh.triangles[:, corner]].astype(np.float64) for corner in range(3))
    face = np.cross(b - a, c - a)
    total = np.zeros((len(mesh.positions), 3))
    for corner in range(3):
        np.add.at(total, mesh.triangles[:, corner], face)
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return np.where(length > 1e-20, total / np.maximum(length, 1e-20), (0.0, 1.0, 0.0)).astype(np.float32)


def vertex_colors(mesh: Mesh) -> Array | None:
    """(V, 3) linear colours that a mesh shows where it has no picture: its attribute `color`; None without one."""
    color = mesh.vertex_attributes.get("color")
    shown = color is not None and color.dtype == np.float32 and color.shape == (len(mesh.positions), 3)
    return color if shown and mesh.texture is None else None
