"""The stage that finds which way the hair runs in the photograph."""

import numpy as np
from numpy.typing import NDArray

from tress.base.report import Report
from tress.image.orient import OrientationMap, OrientParams, brightness, orientation_map

HAIR_ALPHA = 0.5
"""Pixels with more hair than this count as hair."""


def orientation(
    pixels: NDArray[np.uint8],
    *,
    alpha: NDArray[np.float32],
    params: OrientParams = OrientParams.robust(),
    report: Report,
) -> OrientationMap:
    """Orientation of the hair in the photo `pixels` (H, W, 3) uint8; `alpha` (H, W) says how much hair a pixel has."""
    mask = alpha > HAIR_ALPHA
    found = orientation_map(brightness(pixels), mask=mask, params=params)
    report.number("kernel scale", round(found.kernel_scale, 3))
    report.number("confident share", round(float((found.confidence[mask] > 0.3).mean()), 4) if mask.any() else 0.0)
    return found
