"""Which place of the head's surface lies under each texel of its texture."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

ROWS_AT_ONCE = 2000
"""Triangles worked on together; bounds the memory."""


@dataclass(frozen=True)
class Texels:
    """The covered texels of a square texture: `row`, `column` (N,), their `triangle` (N,) and `barycentric` (N, 3)."""

    row: NDArray[np.int64]
    column: NDArray[np.int64]
    triangle: NDArray[np.int64]
    barycentric: NDArray[np.float32]

    def nearest(self, *, size: int) -> NDArray[np.int32]:
        """For every texel of the `size` x `size` texture the covered one (its place in `row`) that is closest to it:
        (size, size)."""
        covered = np.zeros((size, size), np.uint8)
        covered[self.row, self.column] = 1
        _, label = cv2.distanceTransformWithLabels(
            1 - covered, cv2.DIST_L2, cv2.DIST_MASK_5, labelType=cv2.DIST_LABEL_PIXEL
        )
        label = np.asarray(label, np.int32)
        numbers = np.zeros(int(label.max()) + 1, np.int32)
        numbers[label[self.row, self.column]] = np.arange(len(self.row))
        return numbers[label]


def texels(corner_uv: NDArray[np.floating], *, size: int) -> Texels:
    """The texels of a `size` x `size` texture (row 0 on top, v up) whose middle lies in a triangle of `corner_uv` (F,
    3, 2).

    Where triangles touch, the later one has the texel. About 0.2 s for a million texels.
    """
    corners = np.asarray(corner_uv, np.float64) * [size, -size] + [0, size]
    parts = [_covered(corners[k : k + ROWS_AT_ONCE], k, size) for k in range(0, len(corners), ROWS_AT_ONCE)]
    triangle = np.concatenate([part[0] for part in parts])
    barycentric = np.concatenate([part[1] for part in parts])
    pixel = np.concatenate([part[2] for part in parts])
    pixel, last = np.unique(pixel[::-1], return_index=True)
    last = len(triangle) - 1 - last
    row, column = np.divmod(pixel, size)
    return Texels(row, column, triangle[last], barycentric[last].astype(np.float32))


def _covered(
    corners: NDArray[np.float64], first: int, size: int
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]:
    low = np.clip(np.ceil(corners.min(axis=1) - 0.5), 0, size).astype(np.int64)
    high = np.clip(np.floor(corners.max(axis=1) + 0.5), 0, size).astype(np.int64)
    extent = np.maximum(high - low, 0)
    count = extent.prod(axis=1)
    owner = np.repeat(np.arange(len(corners)), count)
    step = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    width = np.maximum(extent[owner, 0], 1)
    column, row = low[owner, 0] + step % width, low[owner, 1] + step // width
    weights = _barycentric(np.stack([column + 0.5, row + 0.5], axis=1), corners[owner])
    inside = (weights >= -1e-6).all(axis=1)
    return owner[inside] + first, weights[inside], (row * size + column)[inside]


def _barycentric(points: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    u, v, w = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], points - corners[:, 0]
    doubled = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    doubled = np.where(np.abs(doubled) < 1e-12, np.inf, doubled)
    second = (w[:, 0] * v[:, 1] - w[:, 1] * v[:, 0]) / doubled
    third = (u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0]) / doubled
    return np.stack([1 - second - third, second, third], axis=1)
