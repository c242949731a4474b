"""One picture that tells how a reconstruction came out: original, re-rendered, both sides, back."""

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np

from tress.base.errors import InputError

Array = np.ndarray[Any, Any]

_CAPTION_PX = 28
GAP_PX = 8
_PAPER = 245
_INK = 40


def contact_sheet(pictures: Sequence[Array], *, captions: Sequence[str], height: int = 480) -> Array:
    """Pictures (H, W, 3) uint8 of any size side by side at one height, each with its caption below: (H', W', 3) uint8.

    Raises `InputError` where captions and pictures differ in number, or there are none.
    """
    if len(pictures) != len(captions) or not pictures:
        raise InputError(f"{len(pictures)} pictures have {len(captions)} captions; the same number was expected.")
    gap = np.full((height + _CAPTION_PX + 2 * GAP_PX, GAP_PX, 3), _PAPER, np.uint8)
    columns = [gap]
    for picture, caption in zip(pictures, captions, strict=True):
        columns += [_column(picture, caption, height), gap]
    return np.concatenate(columns, axis=1)


def _column(picture: Array, caption: str, height: int) -> Array:
    width = max(round(picture.shape[1] * height / picture.shape[0]), 1)
    smaller = height < picture.shape[0]
    resized = cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA if smaller else cv2.INTER_CUBIC)
    column = np.full((height + _CAPTION_PX + 2 * GAP_PX, width, 3), _PAPER, np.uint8)
    column[GAP_PX : GAP_PX + height] = resized
    font, size = cv2.FONT_HERSHEY_SIMPLEX, 0.5
    (text_width, _), _ = cv2.getTextSize(caption, font, size, 1)
    place = (max((width - text_width) // 2, 0), height + GAP_PX + 19)
    cv2.putText(column, caption, place, font, size, (_INK, _INK, _INK), 1, cv2.LINE_AA)
    return column
