"""One picture of an atlas and its maps: the colour over a checkerboard, every map below it."""

from typing import Any

import cv2
import numpy as np

from tress.base.color import linear_to_srgb8, srgb_to_linear
from tress.model.atlas import Atlas
from tress.render.preview import contact_sheet

Array = np.ndarray[Any, Any]

_SHEET_WIDTH = 2000
_COLUMNS = 4
_CHECKS_PX = 24
_LIGHT, _DARK = 0.42, 0.30
"""Linear grey of the squares: bright enough for dark hair to stand out."""
_PAPER = 245


def atlas_sheet(atlas: Atlas) -> Array:
    """(H, W, 3) uint8 sRGB, about 2000 px wide."""
    color = over_checkerboard(atlas.color)
    height, width = color.shape[:2]
    shown = {"alpha": atlas.color[..., 3], **atlas.maps}
    pictures = [_rgb(values) for values in shown.values()]
    names = [name.replace("_", " ") for name in shown]
    small = round(_SHEET_WIDTH / _COLUMNS * height / width)
    rows = [contact_sheet([color], captions=["colour"], height=round(_SHEET_WIDTH * height / width))]
    for first in range(0, len(pictures), _COLUMNS):
        part = slice(first, first + _COLUMNS)
        rows.append(contact_sheet(pictures[part], captions=names[part], height=small))
    return _stacked(rows)


def over_checkerboard(rgba: Array) -> Array:
    """(H, W, 3) uint8 sRGB: `rgba` (H, W, 4), sRGB with straight alpha, blended in linear light over grey squares."""
    rows, columns = np.indices(rgba.shape[:2]) // _CHECKS_PX
    ground = np.where((rows + columns) % 2 == 0, _LIGHT, _DARK).astype(np.float32)[..., None]
    alpha = rgba[..., 3:].astype(np.float32) / 255
    return linear_to_srgb8(srgb_to_linear(rgba[..., :3]) * alpha + ground * (1 - alpha))


def _rgb(values: Array) -> Array:
    return cv2.cvtColor(values, cv2.COLOR_GRAY2RGB) if values.ndim == 2 else values


def _stacked(rows: list[Array]) -> Array:
    width = max(row.shape[1] for row in rows)
    padded = [np.pad(row, ((0, 0), (0, width - row.shape[1]), (0, 0)), constant_values=_PAPER) for row in rows]
    return np.concatenate(padded)
