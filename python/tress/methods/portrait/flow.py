"""Which way the hair flows at every pixel, root to tip: the dense orientation, given a sense.

A picture does not tell forth from back: hair is taken to run away from the crown and downwards, and where that says
nothing (across), as its surroundings do.

Limits: hair combed up from the forehead gets the wrong sense; its orientation is right all the same.
"""

from dataclasses import dataclass, field
from typing import Any

import cv2
import numpy as np

from tress.base.params import Params, param
from tress.image.dense import DenseParams, dense_orientation

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class FlowParams(Params):
    """Settings of the dense flow."""

    dense: DenseParams = field(default_factory=DenseParams)
    sense_mm: float = param(6.0, low=0.0, high=100.0, unit="mm", doc="Width over which neighbours agree on the sense.")
    falling: float = param(1.0, low=0.0, high=10.0, doc="Weight of falling against running away from the crown.")


@dataclass(frozen=True)
class HairFlow:
    """`direction` (H, W, 2) float32 root to tip, unit, y down, zero beside the hair.

    `trust` (H, W) float32 in [0, 1].
    """

    direction: Array
    trust: Array


def hair_flow(
    brightness: Array, *, hair: Array, crown_px: Array, px_per_metre: float, params: FlowParams = FlowParams()
) -> HairFlow:
    """From `brightness` (H, W) in [0, 1], the pixels of `hair` (H, W) bool and the crown's pixel (2,)."""
    direction = np.zeros((*hair.shape, 2), np.float32)
    dense = dense_orientation(brightness, mask=hair, params=params.dense)
    if not hair.any():
        return HairFlow(direction, dense.coherence)
    rows, columns = (np.nonzero(hair.any(axis=k))[0] for k in (1, 0))
    box = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    angle = np.nan_to_num(dense.angle[box])
    axis = np.dstack([np.cos(angle), np.sin(angle)])
    signed = _with_sense(axis, crown_px - np.array([columns[0], rows[0]]), hair[box], px_per_metre, params)
    direction[box] = signed * hair[box][..., None]
    return HairFlow(direction, dense.coherence)


def _blurred(data: Array, sigma: float) -> Array:
    """Gaussian mean; wide ones on a reduced picture."""
    step = max(1, int(sigma / 2))
    if step == 1:
        return cv2.GaussianBlur(data, (0, 0), sigma)
    height, width = data.shape[:2]
    small = cv2.resize(data, (max(1, width // step), max(1, height // step)), interpolation=cv2.INTER_AREA)
    return cv2.resize(cv2.GaussianBlur(small, (0, 0), sigma / step), (width, height), interpolation=cv2.INTER_LINEAR)


def _with_sense(axis: Array, crown_px: Array, hair: Array, px_per_metre: float, params: FlowParams) -> Array:
    height, width = axis.shape[:2]
    away = np.dstack(np.meshgrid(np.arange(width) + 0.5 - crown_px[0], np.arange(height) + 0.5 - crown_px[1]))
    away = away / np.maximum(np.linalg.norm(away, axis=-1, keepdims=True), 0.02 * px_per_metre)
    wish = away + np.array([0.0, params.falling])
    sure = (axis * wish).sum(axis=-1)
    vote = (axis * sure[..., None] * hair[..., None]).astype(np.float32)
    if params.sense_mm > 0:
        vote = _blurred(vote, params.sense_mm * 1e-3 * px_per_metre)
    return axis * np.where((axis * vote).sum(axis=-1) < 0, -1.0, 1.0)[..., None]
