"""Rotation, shift and even scaling: the transforms that keep what hair looks like."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Similarity:
    """A checked (4, 4) float64 matrix and its scale."""

    matrix: Array
    scale: float

    def points(self, points: Array) -> Array:
        """(N, 3) float64 transformed points."""
        return points @ self.matrix[:3, :3].T + self.matrix[:3, 3]


def similarity(matrix: Array, *, accuracy: float = 1e-6) -> Similarity:
    """The similarity that a (4, 4) matrix is. Raises `InputError` where it shears, mirrors or projects.

    >>> round(similarity(np.diag([2.0, 2.0, 2.0, 1.0])).scale, 9)
    2.0
    """
    found = np.asarray(matrix, np.float64)
    if found.shape != (4, 4) or not np.isfinite(found).all() or not np.array_equal(found[3], (0, 0, 0, 1)):
        raise InputError("A transform is a finite (4, 4) matrix with last row 0 0 0 1.")
    linear = found[:3, :3]
    determinant = float(np.linalg.det(linear))
    scale = float(np.cbrt(determinant))
    if scale <= 0 or np.abs(linear @ linear.T / scale**2 - np.eye(3)).max() > accuracy:
        raise InputError("A transform turns, shifts and scales evenly; this one shears, flattens or mirrors.")
    return Similarity(found, scale)
