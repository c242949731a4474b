"""Distances of points from a closed surface, and the way out."""

from typing import Any

import numpy as np

from tress.kernel.geom import signed_distances
from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]

DENSITY = 2  # samples a degree and span: twice as dense as what is shown
ON_SURFACE_M = 1e-7


def distances(mesh: Mesh, points: Array) -> tuple[Array, Array]:
    """(Q,) signed distances of points from a closed mesh, and (Q, 3) unit vectors outwards."""
    found = signed_distances(mesh.positions, triangles=mesh.triangles, queries=points)
    corners = mesh.positions[mesh.triangles[found.triangle]].astype(np.float64)
    away = points - np.einsum("qk,qkd->qd", found.barycentric, corners)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True).clip(1e-30)
    far = np.abs(found.distance) > ON_SURFACE_M
    outwards = away / np.where(far, found.distance, 1.0)[:, None]
    return found.distance, np.where(far[:, None], outwards, normal)
