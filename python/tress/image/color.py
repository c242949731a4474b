"""Colour of photographs: CIE Lab, and the sRGB transfer that every room shares."""

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.color import linear_to_srgb, linear_to_srgb8, luminance, srgb_to_linear
from tress.base.errors import InputError

__all__ = ["lab_of_srgb", "linear_to_srgb", "linear_to_srgb8", "luminance", "require_photograph", "srgb_to_linear"]


def lab_of_srgb(image: NDArray[np.uint8]) -> NDArray[np.float32]:
    """CIE Lab (H, W, 3) float32 of an sRGB photograph (H, W, 3) uint8: L in [0, 100], a and b about [-128, 127].

    White point D65. Raises `InputError` where the image is not (H, W, 3) uint8.

    >>> lab_of_srgb(np.full((1, 1, 3), 255, np.uint8)).round().tolist()
    [[[100.0, 0.0, 0.0]]]
    """
    require_photograph(image)
    return np.asarray(cv2.cvtColor(image.astype(np.float32) / 255, cv2.COLOR_RGB2LAB), np.float32)


def require_photograph(image: NDArray[np.uint8]) -> None:
    """Raises `InputError` unless `image` is (H, W, 3) uint8 with at least one pixel."""
    if image.ndim != 3 or image.shape[2] != 3 or image.dtype != np.uint8 or image.size == 0:
        raise InputError(f"the image is {image.dtype} {image.shape}; uint8 (height, width, 3) was expected.")
