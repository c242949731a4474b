"""Smooths maps so that their edges follow those of a photograph (He, Sun & Tang 2010)."""

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.parallel import each


def guided_filter(
    maps: NDArray[np.float32], *, guide: NDArray[np.uint8], radius: int, epsilon: float = 1e-4
) -> NDArray[np.float32]:
    """`maps` (H, W, C) float32 as local linear functions of the colour photograph `guide` (H, W, 3) uint8.

    Windows are squares of 2 `radius` + 1 pixels. `epsilon` is the colour variance (white = 1) below which a window
    counts as flat and is averaged. Constant maps come back unchanged; maps that add up to 1 still do. Cost: some 60 ms
    for four maps of 640 x 640 pixels.
    """
    color = np.ascontiguousarray((guide / 255).astype(np.float32).transpose(2, 0, 1))
    mean = _box_all(color, radius)
    inverse = _inverse_covariance(color, mean, radius, epsilon)
    smoothed = each(lambda c: _filtered(maps[..., c], color, mean, inverse, radius), range(maps.shape[2]))
    return np.stack(smoothed, axis=-1)


def _filtered(
    values: NDArray[np.float32],
    color: NDArray[np.float32],
    mean: NDArray[np.float32],
    inverse: NDArray[np.float32],
    radius: int,
) -> NDArray[np.float32]:
    value_mean = _box(values, radius)
    together = np.asarray(_box_all(color * values, radius) - mean * value_mean, np.float32)
    slope = np.stack([_weighted(inverse[row], together) for row in _ROWS]).astype(np.float32)
    offset = np.asarray(value_mean - _weighted(slope, mean), np.float32)
    return _weighted(_box_all(slope, radius), color) + _box(offset, radius)


_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""The entries of a symmetric 3 x 3 matrix that are kept, and `_ROWS`, where those of every row are among them."""
_ROWS = ([0, 3, 4], [3, 1, 5], [4, 5, 2])


def _inverse_covariance(
    color: NDArray[np.float32], mean: NDArray[np.float32], radius: int, epsilon: float
) -> NDArray[np.float32]:
    """Inverse of the windows' colour covariance plus `epsilon`, by cofactors: (6, h, w) in the order of `_PAIRS`."""
    square = [_box(color[i] * color[j], radius) - mean[i] * mean[j] + epsilon * (i == j) for i, j in _PAIRS]
    aa, bb, cc, ab, ac, bc = (entry.astype(np.float64) for entry in square)
    cofactor = [bb * cc - bc * bc, aa * cc - ac * ac, aa * bb - ab * ab, ac * bc - ab * cc, ab * bc - ac * bb]
    cofactor.append(ab * ac - aa * bc)
    scale = 1 / (aa * cofactor[0] + ab * cofactor[3] + ac * cofactor[4])
    return np.stack([entry * scale for entry in cofactor]).astype(np.float32)


def _weighted(weights: NDArray[np.float32], planes: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.asarray(weights[0] * planes[0] + weights[1] * planes[1] + weights[2] * planes[2], np.float32)


def _box_all(planes: NDArray[np.float32], radius: int) -> NDArray[np.float32]:
    return np.stack([_box(plane, radius) for plane in planes])


def _box(values: NDArray[np.float32], radius: int) -> NDArray[np.float32]:
    side = 2 * radius + 1
    return np.asarray(cv2.blur(values, (side, side), borderType=cv2.BORDER_REFLECT_101), np.float32)
