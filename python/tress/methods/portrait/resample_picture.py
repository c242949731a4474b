"""Between the photograph's pixels and the columns of the voxel box."""

from typing import Any

import cv2
import numpy as np
from scipy.ndimage import distance_transform_edt

from tress.methods.portrait.box import Box

Array = np.ndarray[Any, Any]


def columns_from_pixels(picture: Array, box: Box, xy_from_view: Array) -> Array:
    """(rows, columns, …) float32: means of `picture` (H, W, …) over the pixels of each column; 0 beyond the photo."""
    scale = xy_from_view[0, 0] * box.size
    u0 = xy_from_view[0, 0] * box.origin[0] + xy_from_view[0, 3]
    v0 = xy_from_view[1, 1] * box.origin[1] + xy_from_view[1, 3]
    fine = max(1, round(scale))
    step = scale / fine
    warp = np.array([[step, 0, u0 + step / 2 - 0.5], [0, step, v0 + step / 2 - 0.5]])
    dense = cv2.warpAffine(
        np.asarray(picture, np.float32),
        warp,
        (box.columns * fine, box.rows * fine),
        flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_CONSTANT,
    )
    return cv2.resize(dense, (box.columns, box.rows), interpolation=cv2.INTER_AREA)


def pixels_from_columns(values: Array, box: Box, xy_from_view: Array, *, shape: tuple[int, int]) -> Array:
    """(H, W) float32: `values` (rows, columns) at every pixel, cubic between the columns' centres, edges continued."""
    height, width = shape
    x = (np.arange(width) + 0.5 - xy_from_view[0, 3]) / xy_from_view[0, 0]
    y = (np.arange(height) + 0.5 - xy_from_view[1, 3]) / xy_from_view[1, 1]
    column = (x - box.origin[0]) / box.size - 0.5
    row = (box.origin[1] - y) / box.size - 0.5
    map_x, map_y = np.meshgrid(column.astype(np.float32), row.astype(np.float32))
    return cv2.remap(
        np.asarray(values, np.float32), map_x, map_y, interpolation=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE
    )


def spread(values: Array, known: Array) -> Array:
    """(rows, columns): `values` where `known`, elsewhere that of the nearest known cell; as they are if none is
    known.
    """
    if not known.any():
        return values
    nearest = distance_transform_edt(~known, return_distances=False, return_indices=True)
    return values[tuple(np.asarray(nearest))]
