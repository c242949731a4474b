"""Strips with points instead of square ends, as clumps of hair are drawn."""

from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

LEAST = 0.02
"""Part of its width that a tip keeps: triangles without an area have no normal."""


def pointed(values: Array, *, fraction: Array, strip: Array, share: float) -> Array:
    """Positions (V, 3), or displacements, on strips whose last `share` of the length narrows to a point.

    Every row of points across, those of one `strip` (V,) and one `fraction` (V, 2) along, goes to its middle; the sides
    are round. Linear in the values, so that displacements of positions stay right.
    """
    place = np.stack([strip, np.round(fraction[:, 0].astype(np.float64) * 1e5)], axis=1)
    row = np.unique(place, axis=0, return_inverse=True)[1].reshape(-1)
    count = np.bincount(row)
    middle = np.stack([np.bincount(row, weights=values[:, axis]) / count for axis in range(3)], axis=1)[row]
    left = np.clip((1 - fraction[:, :1].astype(np.float64)) / max(share, 1e-9), 0, 1)
    width = np.maximum(np.sqrt(left * (2 - left)), LEAST)
    return (middle + width * (values - middle)).astype(np.float32)
