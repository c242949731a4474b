"""The box around a prim."""

from typing import Any

import numpy as np

from tress.io.usd.prim import Attribute


def extent(points: np.ndarray[Any, Any], *, margin: float = 0.0) -> Attribute:
    """The box around (N, 3) points, `margin` metres wider on every side; USD's empty box where there are none."""
    if not len(points):
        limits = np.array([[np.finfo(np.float32).max] * 3, [np.finfo(np.float32).min] * 3], np.float32)
    else:
        low, high = points.min(axis=0) - np.float32(margin), points.max(axis=0) + np.float32(margin)
        limits = np.stack([low, high]).astype(np.float32)
    return Attribute("float3[]", limits)
