"""Light that the hair keeps from itself: the hair as a fog on a grid."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.ndimage import gaussian_filter

from tress.render.flat_scene import FlatScene, tangents

Array = np.ndarray[Any, Any]

_MOST_CELLS = 4_000_000
_DENSITY_PER_M = 70.0
_CELL_M = 0.004


@dataclass(frozen=True, eq=False)
class _Fog:
    """Absorption of every cell (X, Y, Z), and the cell of every point (N,) as an index into the flat grid."""

    absorption: Array
    cell_of_point: Array


def sky_visibility(scene: FlatScene) -> Array:
    """(N,) float32 in [0, 1]: the share of a soft sky that reaches every point of the strands through the hair.

    Light comes along the six directions of the axes, as much from above as from the four sides together, and a quarter
    as much from below. The same for every view. Coarse by design (4 mm): it darkens the depths of a hairstyle, not
    single strands. Cost: linear in points and cells.
    """
    if scene.sky is not None or len(scene.points) == 0:
        return np.zeros(0, np.float32) if scene.sky is None else scene.sky
    fog = _fog(scene.points, scene.offsets)
    total = np.zeros_like(fog.absorption)
    for axis in range(3):
        before = np.cumsum(fog.absorption, axis=axis) - 0.5 * fog.absorption
        after = fog.absorption.sum(axis=axis, keepdims=True) - before
        from_low, from_high = (0.25, 1.0) if axis == 1 else (0.25, 0.25)
        total += from_low * np.exp(-before) + from_high * np.exp(-after)
    return (total / 2.25).reshape(-1)[fog.cell_of_point].astype(np.float32)


def prepared(scene: FlatScene) -> FlatScene:
    """The scene with all that is the same for every view: worth it where more than one picture is made of it."""
    return replace(scene, tangent=tangents(scene), sky=sky_visibility(scene))


def light_transmittance(scene: FlatScene, *, towards_light: Array) -> Array:
    """(N,) float32 in [0, 1]: the share of a distant light in the direction (3,) that reaches every point."""
    if len(scene.points) == 0:
        return np.zeros(0, np.float32)
    fog = _fog(scene.points @ _frame_with_last_axis(towards_light).T.astype(np.float32), scene.offsets)
    absorption = fog.absorption
    behind = np.flip(np.cumsum(np.flip(absorption, axis=2), axis=2), axis=2) - 0.5 * absorption
    return np.exp(-behind).reshape(-1)[fog.cell_of_point].astype(np.float32)


def _fog(points: Array, offsets: Array) -> _Fog:
    """Length of strand in every cell, as absorption: the densest tenth of the cells absorbs the most."""
    extent = np.maximum(np.ptp(points, axis=0), 1e-6)
    cell_m = max(_CELL_M, float((extent.astype(np.float64).prod() / _MOST_CELLS) ** (1 / 3)), extent.max() / 1000)
    cell = ((points - points.min(axis=0)) / cell_m).astype(np.int64) + 1
    size = tuple(cell.max(axis=0) + 2)
    flat = (cell[:, 0] * size[1] + cell[:, 1]) * size[2] + cell[:, 2]
    length = np.bincount(flat, weights=_lengths(points, offsets), minlength=int(np.prod(size))).reshape(size)
    smooth = gaussian_filter(length, 0.8)
    filled = smooth[length > 0]
    dense = max(float(np.percentile(filled, 90)) if filled.size else 0.0, 1e-12)
    absorption = _DENSITY_PER_M * cell_m * np.minimum(smooth / dense, 1.0)
    return _Fog(absorption, flat)


def _lengths(points: Array, offsets: Array) -> Array:
    """(N,) metres of strand that belong to every point: the segment that begins there."""
    step = np.zeros(len(points))
    step[:-1] = np.linalg.norm(np.diff(points, axis=0), axis=1)
    step[offsets[1:] - 1] = 0
    return step


def _frame_with_last_axis(direction: Array) -> Array:
    """Orthonormal rows, the last along the direction."""
    last = np.asarray(direction, np.float64) / np.linalg.norm(direction)
    other = np.eye(3)[np.argmin(np.abs(last))]
    first = np.cross(other, last)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(last, first), last])
