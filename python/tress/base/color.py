"""The sRGB transfer curve: photographs and files are sRGB, everything inside Tress is linear light.

Source: IEC 61966-2-1. The linear piece near black is kept, so that both functions are exact inverses.
"""

import numpy as np
from numpy.typing import NDArray

_KNEE_SRGB = 0.04045
_KNEE_LINEAR = 0.0031308

# Rec. 709 weights of the linear channels in luminance.
LUMINANCE_WEIGHTS = np.array([0.2126, 0.7152, 0.0722], np.float32)


def srgb_to_linear(image: NDArray[np.uint8] | NDArray[np.floating]) -> NDArray[np.float32]:
    """Linear light of an sRGB image of any shape: float32, [0, 1] for input in range.

    `uint8` input counts 255 as white, floating-point input 1.0. Only colour channels may be passed: alpha is linear.

    >>> bool(abs(srgb_to_linear(np.array([0.5]))[0] - 0.21404114) < 1e-6)
    True
    """
    if image.dtype == np.uint8:
        return _LINEAR_OF_BYTE[image.astype(np.uint8, copy=False)]
    return _decoded(np.asarray(image, np.float32))


def linear_to_srgb(image: NDArray[np.floating]) -> NDArray[np.float32]:
    """sRGB values in [0, 1] (float32) of linear light; input outside [0, 1] is clipped.

    >>> linear_to_srgb(np.array([0.0, 1.0, 7.0])).round(6).tolist()
    [0.0, 1.0, 1.0]
    """
    linear = np.clip(np.asarray(image, np.float32), 0.0, 1.0)
    curve = np.float32(1.055) * np.power(np.maximum(linear, _KNEE_LINEAR), np.float32(1 / 2.4)) - np.float32(0.055)
    return np.where(linear <= _KNEE_LINEAR, linear * np.float32(12.92), np.minimum(curve, np.float32(1.0)))


def linear_to_srgb8(image: NDArray[np.floating]) -> NDArray[np.uint8]:
    """sRGB bytes of linear light, rounded to the nearest; input outside [0, 1] is clipped."""
    return (linear_to_srgb(image) * 255.0 + 0.5).astype(np.uint8)


def luminance(linear: NDArray[np.floating]) -> NDArray[np.float32]:
    """Relative luminance (...,) float32 of linear colours (..., 3), Rec. 709 primaries."""
    return np.asarray(linear, np.float32) @ LUMINANCE_WEIGHTS


def _decoded(srgb: NDArray[np.float32]) -> NDArray[np.float32]:
    curve = np.power((np.maximum(srgb, _KNEE_SRGB) + np.float32(0.055)) / np.float32(1.055), np.float32(2.4))
    return np.where(srgb <= _KNEE_SRGB, srgb / np.float32(12.92), curve).astype(np.float32)


_LINEAR_OF_BYTE = _decoded(np.arange(256, dtype=np.float32) / np.float32(255.0))
