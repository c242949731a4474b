"""Colour and opacity of every vertex: from the photograph where it is seen, from hair near by where it is hidden."""

from typing import Any

import cv2
import numpy as np

from tress.methods.portrait.volume import HairVolume

Array = np.ndarray[Any, Any]

ON_SHEET = 0.004
"""Metres behind the visible surface within which a visible strand shows the photograph's colour."""
SOLID_ALPHA = 0.9
"""Pixels with less hair lend no colour to hidden strands."""
WANDER_PX = 6.0
"""How far hidden strands look around for their colour, so that neighbours differ as in the photograph."""


def strand_colors(
    points: Array,
    offsets: Array,
    visible: Array,
    hair: HairVolume,
    foreground: Array,
    alpha: Array,
    xy_from_view: Array,
    random: np.random.Generator,
) -> tuple[Array, Array]:
    """(N, 3) float32 linear and (N,) float32: a visible vertex takes its own pixel of the matte.

    A hidden one takes the nearest solid hair pixel to where it projects, moved by an offset drawn for its strand.
    """
    shape = alpha.shape
    pixel = points[:, :2] * [xy_from_view[0, 0], xy_from_view[1, 1]] + xy_from_view[:2, 3]
    count = np.diff(offsets)
    of_visible = np.repeat(visible, count)
    sheet = hair.sheet[_index(pixel, shape)]
    shown = of_visible & (np.abs(points[:, 2] - sheet) < ON_SHEET)
    drift = np.repeat(random.normal(0, WANDER_PX, (len(count), 2)), count, axis=0)
    solid = _nearest_solid(alpha, hair)
    from_row, from_column = (m[_index(pixel + drift, shape)] for m in solid)
    color = foreground[from_row, from_column].astype(np.float32)
    color[shown] = _bilinear(foreground, pixel[shown])
    opacity = np.ones(len(points), np.float32)
    opacity[shown] = np.clip(_bilinear(alpha, pixel[shown]), 0, 1)
    return color, opacity


def _index(pixel: Array, shape: tuple[int, ...]) -> tuple[Array, Array]:
    """Rows and columns of the pixels that hold the places (N, 2), those outside moved to the border."""
    column, row = (np.clip(pixel[:, k].astype(np.int64), 0, shape[1 - k] - 1) for k in (0, 1))
    return row, column


def _bilinear(picture: Array, pixel: Array) -> Array:
    """Values (N, …) of a picture between its pixels' centres."""
    place = np.asarray(pixel, np.float32) - np.float32(0.5)
    rows = max(1, -(-len(place) // 8192))
    padded = np.zeros((rows * 8192, 2), np.float32)
    padded[: len(place)] = place
    grid = padded.reshape(rows, 8192, 2)
    found = cv2.remap(
        np.asarray(picture, np.float32), grid[..., 0], grid[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    return found.reshape(rows * 8192, *np.shape(picture)[2:])[: len(place)]


def _nearest_solid(alpha: Array, hair: HairVolume) -> tuple[Array, Array]:
    """Row and column (H, W) of the solid hair pixel nearest to each pixel; of any hair pixel if none is solid."""
    hairy = np.isfinite(hair.sheet)
    solid = hairy & (alpha > SOLID_ALPHA)
    source = solid if solid.any() else hairy
    rows, columns = np.nonzero(source)
    _, nearest = cv2.distanceTransformWithLabels(
        (~source).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    labels: Array = np.asarray(nearest)
    order: Array = np.zeros(labels.max() + 1, np.int64)
    order[labels[rows, columns]] = np.arange(len(rows))
    return rows[order[labels]], columns[order[labels]]
