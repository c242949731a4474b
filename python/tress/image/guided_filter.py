"""Smooths maps so that their edges follow those of a photograph (He, Sun & Tang 2010)."""

import cv2
import numpy as np
from numpy.typing import NDArray


def guided_filter(
    maps: NDArray[np.float32], *, guide: NDArray[np.uint8], radius: int, epsilon: float = 1e-4
) -> NDArray[np.float32]:
    """`maps` (H, W, C) float32 as local linear functions of the colour photograph `guide` (H, W, 3) uint8.

    Windows are squares of 2 `radius` + 1 pixels. `epsilon` is the colour variance (white = 1) below which a window
    counts as flat and is averaged. Constant maps come back unchanged; maps that add up to 1 still do. Cost: some 60 ms
    for four maps of 640 x 640 pixels.
    """
    color = (guide / 255).astype(np.float32)
    mean = _box(color, radius)
    inverse = _inverse_covariance(color, mean, radius, epsilon)
    smoothed = [_filtered(maps[..., c], color, mean, inverse, radius) for c in range(maps.shape[2])]
    return np.stack(smoothed, axis=-1)


def _filtered(
    values: NDArray[np.float32],
    color: NDArray[np.float32],
    mean: NDArray[np.float32],
    inverse: NDArray[np.float32],
    radius: int,
) -> NDArray[np.float32]:
    value_mean = _box(values, radius)
    together = _box(color * values[..., None], radius) - mean * value_mean[..., None]
    slope = np.einsum("hwij,hwj->hwi", inverse, together)
    offset = value_mean - (slope * mean).sum(axis=-1)
    return (_box(slope, radius) * color).sum(axis=-1) + _box(offset, radius)


def _inverse_covariance(
    color: NDArray[np.float32], mean: NDArray[np.float32], radius: int, epsilon: float
) -> NDArray[np.float32]:
    height, width = color.shape[:2]
    square = np.empty((height, width, 3, 3), np.float32)
    for i in range(3):
        for j in range(i, 3):
            square[..., i, j] = _box(color[..., i] * color[..., j], radius) - mean[..., i] * mean[..., j]
            square[..., j, i] = square[..., i, j]
    square += epsilon * np.eye(3, dtype=np.float32)
    return np.linalg.inv(square)


def _box(values: NDArray[np.float32], radius: int) -> NDArray[np.float32]:
    side = 2 * radius + 1
    return cv2.blur(values, (side, side), borderType=cv2.BORDER_REFLECT_101)  # type: ignore[return-value]
