"""Strips with points instead of square ends, as clumps of hair are drawn."""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]

LEAST = 0.02
"""Part of its width that a tip keeps: triangles without an area have no normal."""


def pointed(mesh: Mesh, *, share: float) -> Mesh:
    """A mesh of strips whose last `share` of the length narrows to a point, with round sides.

    Every row of points across goes to its middle. The strips themselves stay as they are.
    """
    fraction = mesh.vertex_attributes["fraction"].astype(np.float64)
    row = np.stack([mesh.vertex_attributes["strip"], np.round(fraction[:, 0] * 1e5)], axis=1)
    _, row = np.unique(row, axis=0, return_inverse=True)
    row = row.reshape(-1)
    count = np.bincount(row)
    middle = np.stack([np.bincount(row, weights=mesh.positions[:, axis]) / count for axis in range(3)], axis=1)[row]
    left = np.clip((1 - fraction[:, :1]) / max(share, 1e-9), 0, 1)
    width = np.maximum(np.sqrt(left * (2 - left)), LEAST)
    positions = middle + width * (mesh.positions - middle)
    return replace(mesh, positions=positions.astype(np.float32))
