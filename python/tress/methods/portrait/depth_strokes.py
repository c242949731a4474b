"""The user's marks of known depth: polylines in pixels of the photo, each with its depth in metres."""

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError

_DEFAULT_WIDTH_PX: Final = 8.0
_DEEPEST_M: Final = 1.0


def read_depth_strokes(
    path: Path, *, shape: tuple[int, int], scale: tuple[float, float] = (1.0, 1.0)
) -> NDArray[np.float32]:
    """Depths (H, W) float32, metres towards the camera from the head's centre; NaN where there is no stroke.

    The file is JSON: `{"strokes": [{"depth_m": 0.08, "width": 10, "points": [[x, y], ...]}]}`; widths (8 px if absent)
    and points are in pixels that `scale` (x, y) takes to those of `shape`. Later strokes lie over earlier ones.

    Raises `InputError` where the file cannot be read or a stroke lacks a part.
    """
    try:
        strokes = json.loads(path.read_text("utf-8"))["strokes"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(
            f'The depth strokes {path} cannot be read ({error}); {{"strokes": [...]}} was expected.'
        ) from None
    if not isinstance(strokes, list):
        raise InputError(f"The depth strokes {path} hold no list of strokes.")
    return depth_strokes_map(strokes, shape=shape, scale=scale)


def depth_strokes_map(
    strokes: Sequence[Mapping[str, Any]], *, shape: tuple[int, int], scale: tuple[float, float] = (1.0, 1.0)
) -> NDArray[np.float32]:
    """Depths (H, W) float32 of strokes, as in `read_depth_strokes`.

    >>> marks = depth_strokes_map([{"depth_m": 0.1, "width": 1, "points": [[0.5, 1.5], [2.5, 1.5]]}], shape=(3, 3))
    >>> np.isfinite(marks).tolist()
    [[False, False, False], [True, True, True], [False, False, False]]
    """
    depth = np.full(shape, np.nan, np.float32)
    for number, stroke in enumerate(strokes):
        value, width, points = _checked(stroke, number)
        fixed = np.rint((points * scale - 0.5) * 16).astype(np.int32)  # OpenCV's sub-pixel coordinates have four bits
        drawn = np.zeros(shape, np.uint8)
        thickness = max(1, round(width * sum(scale) / 2))
        cv2.polylines(drawn, [fixed], isClosed=False, color=1, thickness=thickness, lineType=cv2.LINE_8, shift=4)
        depth[drawn > 0] = value
    return depth


def _checked(stroke: Mapping[str, Any], number: int) -> tuple[float, float, NDArray[np.float64]]:
    try:
        value, width = float(stroke["depth_m"]), float(stroke.get("width", _DEFAULT_WIDTH_PX))
        points = np.asarray(stroke["points"], np.float64)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise InputError(f"Depth stroke {number} is incomplete ({error}); depth_m and points are needed.") from None
    if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all() or np.abs(points).max() > 1e5:
        raise InputError(f"Depth stroke {number} has points of shape {points.shape}; (N, 2) finite px were expected.")
    if not (math.isfinite(value) and abs(value) <= _DEEPEST_M and 0 < width <= 1e4):
        raise InputError(
            f"Depth stroke {number} has depth {value} m and width {width}; metres within ±1 were expected."
        )
    return value, width, points
