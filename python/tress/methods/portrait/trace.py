"""The stage that traces strands in the photograph."""

import numpy as np
from numpy.typing import NDArray

from tress.base.report import Report
from tress.image.orient import OrientationMap
from tress.image.trace import TracedStrands, TraceParams, traced_strands

SEEN_ALPHA = 0.1
"""Strands are followed as long as the pixels have more hair than this."""


def trace(
    orientation: OrientationMap,
    *,
    alpha: NDArray[np.float32],
    foreground: NDArray[np.float32],
    params: TraceParams = TraceParams.robust(),
    report: Report,
) -> TracedStrands:
    """Strands of the photo, with the colour `foreground` (H, W, 3) linear and `alpha` (H, W) of its matte."""
    found = traced_strands(orientation, mask=alpha > SEEN_ALPHA, foreground=foreground, alpha=alpha, params=params)
    report.number("strands", found.count)
    report.number("vertices", len(found.points))
    report.number("occluded vertices", int(found.occluded.sum()))
    if found.count == 0:
        report.warn("No strand could be traced in the photo; the hair will follow the smooth orientation alone.")
    return found
