"""From numbers to bytes and back: one rule for every kind of map.

Directions: 128 is exactly 0 and one unit is 127 steps, so that straight down and straight towards the viewer have exact
bytes. Shares in [0, 1] fill 0 to 255.
"""

from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

_ZERO, _UNIT = 128, 127


def direction_bytes(vectors: Array) -> Array:
    """(..., 3) uint8 of vectors (..., 3), made unit first; no vector at all becomes the one towards the viewer."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    unit = np.where(length > 1e-9, vectors / np.maximum(length, 1e-9), np.array([0, 0, 1]))
    return np.rint(unit * _UNIT + _ZERO).astype(np.uint8)


def directions(pixels: Array) -> Array:
    """(..., 3) float32: the vectors of `direction_bytes`."""
    return (pixels.astype(np.float32) - _ZERO) / _UNIT


def share_bytes(shares: Array) -> Array:
    """uint8 of shares, clipped to [0, 1]."""
    return np.rint(np.clip(shares, 0, 1) * 255).astype(np.uint8)


def shares(pixels: Array) -> Array:
    """float32 in [0, 1]."""
    return pixels.astype(np.float32) / np.float32(255)
