"""Hair as a fog on a grid: how much light comes through it to a point."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

_MOST_CELLS = 4_000_000
_CELL_M = 0.004


@dataclass(frozen=True, eq=False)
class Fog:
    """Absorption (3, X, Y, Z) of every cell for light along each axis, and the cell of every point (N,) as an index
    into the flat grid."""

    absorption: Array
    cell_of_point: Array

    def sky(self) -> Array:
        """(N,) float32 in [0, 1]: the share of a soft sky that reaches every point.

        Light comes along the six directions of the axes, as much from above as from the four sides together, and a
        quarter as much from below.
        """
        total = np.zeros_like(self.absorption[0])
        for axis, absorption in enumerate(self.absorption):
            before = np.cumsum(absorption, axis=axis) - 0.5 * absorption
            after = absorption.sum(axis=axis, keepdims=True) - before
            from_low, from_high = (0.25, 1.0) if axis == 1 else (0.25, 0.25)
            total += from_low * np.exp(-before) + from_high * np.exp(-after)
        return self._at_points(total / 2.25)

    def light(self) -> Array:
        """(N,) float32 in [0, 1]: the share of a light along the last axis, from its high end, at every point."""
        absorption = self.absorption[2]
        behind = np.flip(np.cumsum(np.flip(absorption, axis=2), axis=2), axis=2) - 0.5 * absorption
        return self._at_points(np.exp(-behind))

    def _at_points(self, values: Array) -> Array:
        return values.reshape(-1)[self.cell_of_point].astype(np.float32)


def fog(points: Array, *, amount: Array, absorption: Callable[[Array, float], Array]) -> Fog:
    """Points (N, 3) with an `amount` of hair each, (N,), or (N, 3) where the axes see it differently, as they do a
    sheet; `absorption(amounts (X, Y, Z), cell_m)` says what it takes."""
    extent = np.maximum(np.ptp(points, axis=0), 1e-6)
    cell_m = max(_CELL_M, float((extent.astype(np.float64).prod() / _MOST_CELLS) ** (1 / 3)), extent.max() / 1000)
    cell = ((points - points.min(axis=0)) / cell_m).astype(np.int64) + 1
    size = tuple(cell.max(axis=0) + 2)
    flat = (cell[:, 0] * size[1] + cell[:, 1]) * size[2] + cell[:, 2]
    found = [
        absorption(np.bincount(flat, weights=column, minlength=int(np.prod(size))).reshape(size), cell_m)
        for column in np.atleast_2d(np.asarray(amount).T)
    ]
    return Fog(np.broadcast_to(np.stack(found), (3, *size)), flat)


def frame_with_last_axis(direction: Array) -> Array:
    """Orthonormal rows, the last along the direction."""
    last = np.asarray(direction, np.float64) / np.linalg.norm(direction)
    other = np.eye(3)[np.argmin(np.abs(last))]
    first = np.cross(other, last)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(last, first), last])
