"""Strands traced in the picture, with their colours. Source: Chai et al. 2012, section 3.2.2."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError
from tress.base.params import Params, param
from tress.image.orient import OrientationMap
from tress.kernel.image import trace

_REACH_PX = 1.5
"""Distance of the flanks for kernels of the paper's size. A ridge between two pixels has no flanks at 1 px."""


@dataclass(frozen=True)
class TraceParams(Params):
    """Settings of `traced_strands`. The defaults are the paper's; what it does not know is off by default."""

    high: float = param(
        0.3, low=0.0, high=1.0, doc="Confidence above which a pixel may be a seed (w_high, below eq. 4)."
    )
    low: float = param(
        0.05, low=0.0, high=1.0, doc="Confidence below which a strand becomes uncertain (w_low, below eq. 4)."
    )
    epsilon: float = param(0.2, low=0.0, high=1.0, doc="Share by which a seed stands out over its flanks (ε, eq. 4).")
    health: int = param(5, low=1, high=1000, unit="steps", doc='Uncertain steps that end a strand ("health point").')
    step_px: float = param(0.75, low=0.05, high=8.0, unit="px", doc='Length of a step (δ, "75% of the pixel width").')
    max_bend: float = param(
        float(np.pi / 6), low=0.01, high=1.57, unit="rad", doc="Largest bend of a certain step (θ_max, rules 3 and 4)."
    )
    reach_px: float = param(
        0.0,
        low=0.0,
        high=16.0,
        unit="px",
        doc='Distance of the flanks p_L and p_R ("nearby" in the paper); 0: three eighths of the kernels\' wavelength.',
    )
    min_length_px: float = param(
        0.0, low=0.0, high=1000.0, unit="px", doc="Shorter strands are dropped; the paper keeps all."
    )
    smoothing_px: float = param(
        0.0, low=0.0, high=50.0, unit="px", doc="Width over which finished strands are smoothed; the paper's are not."
    )

    @classmethod
    def robust(cls) -> "TraceParams":
        """For photographs: what is too short to be a strand is dropped, and the steps of the pixels smoothed away."""
        return cls(min_length_px=6.0, smoothing_px=2.0)


@dataclass(frozen=True, eq=False)
class TracedStrands:
    """Strands seen in the picture: strand i is `points[offsets[i]:offsets[i + 1]]`; which end is the root is not known.

    `points` (N, 2) float32 px; `offsets` (S + 1,) int64; `occluded` (N,) bool: passes under another strand there;
    `confidence` (N,) float32 in [0, 1]; `color` (N, 3) float32 linear; `alpha` (N,) float32 in [0, 1].
    """

    points: NDArray[np.float32]
    offsets: NDArray[np.int64]
    occluded: NDArray[np.bool_]
    confidence: NDArray[np.float32]
    color: NDArray[np.float32]
    alpha: NDArray[np.float32]

    def __post_init__(self) -> None:
        count = len(self.points)
        fits = all(len(array) == count for array in (self.occluded, self.confidence, self.color, self.alpha))
        if not fits or self.points.shape != (count, 2) or self.color.shape != (count, 3):
            raise InputError(f"The arrays of traced strands do not all have {count} rows.")
        if (
            len(self.offsets) == 0
            or self.offsets[0] != 0
            or self.offsets[-1] != count
            or (np.diff(self.offsets) < 2).any()
        ):
            raise InputError(f"offsets must run from 0 to {count} in steps of at least 2.")
        for array in (self.points, self.offsets, self.occluded, self.confidence, self.color, self.alpha):
            array.flags.writeable = False

    @property
    def count(self) -> int:
        """Number of strands."""
        return len(self.offsets) - 1


def traced_strands(
    orientation: OrientationMap,
    *,
    mask: NDArray[np.bool_],
    foreground: NDArray[np.float32],
    alpha: NDArray[np.float32],
    params: TraceParams = TraceParams(),
) -> TracedStrands:
    """Strands along the ridges of confidence in `mask` (H, W) bool, with the hair's own colour and opacity.

    `foreground` (H, W, 3) float32 linear and `alpha` (H, W) float32 are those of the matte. The same picture gives the
    same strands on any number of threads. Raises `InputError` where shapes do not fit.
    """
    shape = orientation.angle.shape
    if mask.shape != shape or foreground.shape != (*shape, 3) or alpha.shape != shape:
        raise InputError(
            f"mask {mask.shape}, foreground {foreground.shape}, alpha {alpha.shape}: {shape} was expected."
        )
    curves = trace(
        orientation.angle,
        confidence=orientation.confidence,
        mask=mask,
        high=params.high,
        low=params.low,
        epsilon=params.epsilon,
        health=params.health,
        step_px=params.step_px,
        max_bend=params.max_bend,
        reach_px=params.reach_px or _REACH_PX * orientation.kernel_scale,
        min_length_px=params.min_length_px,
        smoothing_px=params.smoothing_px,
    )
    color = sampled(foreground, points=curves.points)
    opacity = np.clip(sampled(alpha, points=curves.points), 0, 1)
    return TracedStrands(curves.points, curves.offsets, curves.occluded, curves.confidence, color, opacity)


def sampled(image: NDArray[np.floating], *, points: NDArray[np.floating]) -> NDArray[np.float32]:
    """Bilinear values (N, ...) float32 of `image` (H, W, ...) at `points` (N, 2) px, the border repeated outside."""
    values = np.asarray(image, np.float32)
    if len(points) == 0:
        return np.zeros((0, *values.shape[2:]), np.float32)
    height, width = values.shape[:2]
    x = np.clip(np.asarray(points[:, 0], np.float64) - 0.5, 0, width - 1)
    y = np.clip(np.asarray(points[:, 1], np.float64) - 0.5, 0, height - 1)
    left, top = np.minimum(x.astype(int), max(width - 2, 0)), np.minimum(y.astype(int), max(height - 2, 0))
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    extra = (1,) * (values.ndim - 2)
    fx, fy = (x - left).reshape(-1, *extra), (y - top).reshape(-1, *extra)
    upper = values[top, left] * (1 - fx) + values[top, right] * fx
    lower = values[bottom, left] * (1 - fx) + values[bottom, right] * fx
    return (upper * (1 - fy) + lower * fy).astype(np.float32)
