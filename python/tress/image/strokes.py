"""The user's strokes: which layer some pixels surely belong to. From a mask picture or from JSON polylines."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError
from tress.image.labels import BACKGROUND, BODY, FACE, HAIR

NO_STROKE: Final = 255
"""Value of a strokes map where the user said nothing."""

LAYER_OF_NAME: Final[Mapping[str, int]] = {"background": BACKGROUND, "body": BODY, "face": FACE, "hair": HAIR}

LAYER_OF_COLOR: Final[Mapping[tuple[int, int, int], int]] = {
    (0, 0, 255): BACKGROUND,
    (0, 255, 0): BODY,
    (255, 255, 0): FACE,
    (255, 0, 0): HAIR,
}
"""Stroke colours of a colour mask: blue background, green body, yellow face, red hair; others are no stroke."""

_DEFAULT_WIDTH_PX: Final = 8.0


def read_strokes(path: Path, *, shape: tuple[int, int]) -> NDArray[np.uint8]:
    """Strokes map (H, W) uint8 of a photograph of `shape` (H, W): a layer's label, or 255 where there is no stroke.

    A `.json` file holds polylines in pixels, `{"strokes": [{"layer": "hair", "width": 12, "points": [[x, y], ...]}]}`;
    any other file is a picture of the photograph's size, grey (values 0 to 3 are labels) or in the stroke colours.

    Raises `InputError` where the file is absent, is neither, or does not fit the photograph.
    """
    if not path.is_file():
        raise InputError(f"the strokes file {path} does not exist.")
    if path.suffix.lower() == ".json":
        return _read_json(path, shape)
    picture = cv2.imdecode(np.frombuffer(path.read_bytes() or b"\0", np.uint8), cv2.IMREAD_UNCHANGED)
    if picture is None:
        raise InputError(f"the strokes file {path} is neither JSON nor a picture that can be read.")
    return strokes_from_mask(_rgba_or_grey(picture), shape=shape)


def strokes_from_mask(mask: NDArray[np.uint8], *, shape: tuple[int, int]) -> NDArray[np.uint8]:
    """Strokes map (H, W) uint8 of a mask (H, W) of labels, or (H, W, 3 | 4) RGB(A) in the stroke colours.

    Grey values above 3, other colours and transparent pixels are no stroke. Raises `InputError` where the size or the
    depth is not right.
    """
    if mask.dtype != np.uint8 or mask.ndim not in (2, 3) or (mask.ndim == 3 and mask.shape[2] not in (3, 4)):
        raise InputError(f"the strokes mask is {mask.dtype} {mask.shape}; 8 bits, grey or RGB were expected.")
    if mask.shape[:2] != tuple(shape):
        raise InputError(
            f"the strokes mask is {mask.shape[1]} x {mask.shape[0]} px; "
            f"the photograph's {shape[1]} x {shape[0]} px were expected."
        )
    if mask.ndim == 2:
        return np.where(mask <= HAIR, mask, NO_STROKE).astype(np.uint8)
    strokes = np.full(shape, NO_STROKE, np.uint8)
    for color, layer in LAYER_OF_COLOR.items():
        strokes[(mask[..., :3] == color).all(axis=-1)] = layer
    if mask.shape[2] == 4:
        strokes[mask[..., 3] < 128] = NO_STROKE
    return strokes


def strokes_from_polylines(strokes: Sequence[Mapping[str, Any]], *, shape: tuple[int, int]) -> NDArray[np.uint8]:
    """Strokes map (H, W) uint8 of polylines: `layer` (a name), `points` (N, 2) px, `width` px (8 if absent).

    Later strokes lie over earlier ones; what is outside the photograph is cut off. Raises `InputError` where a stroke
    lacks a part, a value makes no sense, or all of it lies beside the photograph.
    """
    drawn = np.full(shape, NO_STROKE, np.uint8)
    for number, stroke in enumerate(strokes):
        layer, points, width = _checked_stroke(stroke, number)
        _check_touches(points, width, number, shape)
        _draw(drawn, layer, points, width)
    return drawn


def _read_json(path: Path, shape: tuple[int, int]) -> NDArray[np.uint8]:
    try:
        content = json.loads(path.read_text("utf-8"))
    except ValueError as error:
        raise InputError(f"the strokes file {path} is not JSON: {error}.") from error
    strokes = content.get("strokes") if isinstance(content, dict) else None
    if not isinstance(strokes, list):
        raise InputError(f'the strokes file {path} has no list "strokes".')
    return strokes_from_polylines(strokes, shape=shape)


def _checked_stroke(stroke: Any, number: int) -> tuple[int, NDArray[np.float64], float]:
    if not isinstance(stroke, Mapping):
        raise InputError(f"stroke {number} is {stroke!r}; an object with layer, width and points was expected.")
    name = stroke.get("layer")
    if name not in LAYER_OF_NAME:
        raise InputError(f"stroke {number} names the layer {name!r}; one of {', '.join(LAYER_OF_NAME)} was expected.")
    width = stroke.get("width", _DEFAULT_WIDTH_PX)
    if isinstance(width, bool) or not isinstance(width, int | float) or not 0 < width <= 10_000:
        raise InputError(f"stroke {number} has the width {width!r}; pixels above 0 were expected.")
    try:
        points: NDArray[Any] = np.array(stroke.get("points"), np.float64)
    except (TypeError, ValueError):
        points = np.empty((0, 0))
    if points.ndim != 2 or points.shape[1] != 2 or len(points) == 0 or not np.isfinite(points).all():
        raise InputError(f"stroke {number} has no points; a list of [x, y] in pixels was expected.")
    return LAYER_OF_NAME[name], np.clip(points, -1e5, 1e5), float(width)


def _check_touches(points: NDArray[np.float64], width_px: float, number: int, shape: tuple[int, int]) -> None:
    low, high = points.min(axis=0) - width_px / 2, points.max(axis=0) + width_px / 2
    if (high < 0).any() or (low > shape[::-1]).any():
        raise InputError(
            f"stroke {number} lies beside the photograph of {shape[1]} x {shape[0]} px; "
            "points in its own pixels, x to the right and y down, were expected."
        )


def _draw(drawn: NDArray[np.uint8], layer: int, points: NDArray[np.float64], width_px: float) -> None:
    shift = 4  # OpenCV's fixed point; its pixel centres lie on whole numbers, ours at + 0.5
    fixed = np.rint((points - 0.5) * (1 << shift)).astype(np.int32)
    if len(fixed) == 1:
        cv2.circle(drawn, fixed[0].tolist(), round(width_px / 2 * (1 << shift)), layer, -1, cv2.LINE_8, shift)
        return
    cv2.polylines(drawn, [fixed], False, layer, max(1, round(width_px)), cv2.LINE_8, shift)


def _rgba_or_grey(picture: NDArray[Any]) -> NDArray[np.uint8]:
    if picture.ndim == 2:
        return picture
    return picture[..., [2, 1, 0, *range(3, picture.shape[2])]]
