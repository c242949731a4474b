"""How open the strands of a card lie to the light, from their depth alone."""

from typing import Any

import cv2
import numpy as np

Array = np.ndarray[Any, Any]

_SCALES = (0.015, 0.045)
"""Radii of the neighbourhoods that are looked at, in card widths."""
_STRENGTH = 4.5


def ambient_occlusion(depth: Array, *, coverage: Array) -> Array:
    """(H, W) float32 in [0, 1], 1 where nothing around stands nearer: one minus how far the neighbourhood stands out.

    `depth` (H, W), 1 near, is weighted by `coverage` (H, W). A cheap estimate: heights are compared with their blurred
    neighbours (unsharp masking of the depth buffer, Luft et al. 2006), no rays are cast.
    """
    height, weight = np.asarray(depth, np.float32), np.asarray(coverage, np.float32)
    hidden = np.zeros_like(height)
    for scale in _SCALES:
        sigma = max(scale * height.shape[1], 0.5)
        around = cv2.GaussianBlur(weight, (0, 0), sigma)
        mean = cv2.GaussianBlur(height * weight, (0, 0), sigma) / np.maximum(around, 1e-6)
        hidden += np.clip(mean - height, 0, None) * around
    return np.exp(-_STRENGTH * hidden).astype(np.float32)
