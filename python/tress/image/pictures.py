"""Pictures to judge traced strands and confidence by. All are (H, W, 3) uint8 sRGB."""

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError
from tress.image.trace import TracedStrands

_SHIFT = 4
"""OpenCV draws at points in units of 2**-_SHIFT px."""
_HIDDEN = (255, 60, 60)


def confidence_picture(confidence: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Confidence (H, W) in [0, 1] as brightness from black to yellow."""
    level = (np.clip(confidence, 0, 1) * 255).astype(np.uint8)
    return np.asarray(cv2.applyColorMap(level, cv2.COLORMAP_INFERNO)[..., ::-1], np.uint8).copy()


def traced_picture(pixels: NDArray[np.uint8], *, traced: TracedStrands, seed: int = 0) -> NDArray[np.uint8]:
    """Strands in random colours over the darkened photo `pixels` (H, W, 3); dots mark occluded vertices.

    Raises `InputError` where the photo is no (H, W, 3) uint8.
    """
    if pixels.ndim != 3 or pixels.shape[2] != 3 or pixels.dtype != np.uint8:
        raise InputError(f"pixels are {pixels.dtype} {pixels.shape}; uint8 (H, W, 3) was expected.")
    picture = pixels // 3
    colors = np.random.default_rng(seed).integers(100, 256, (traced.count, 3)).tolist()
    fixed = np.rint((traced.points - 0.5) * 2**_SHIFT).astype(np.int32)
    for strand, color in enumerate(colors):
        curve = fixed[traced.offsets[strand] : traced.offsets[strand + 1]]
        cv2.polylines(picture, [curve], isClosed=False, color=color, lineType=cv2.LINE_AA, shift=_SHIFT)
    for x, y in fixed[traced.occluded].tolist():
        cv2.circle(picture, (x, y), 2**_SHIFT, _HIDDEN, -1, cv2.LINE_AA, _SHIFT)
    return picture
