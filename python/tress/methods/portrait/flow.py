"""Which way the hair flows at every pixel, root to tip: dense, smooth, and with a sense.

The sparse orientation that strands are traced from is exact on prominent strands and noise between them: it decides at
each pixel alone. For a dense field the evidence is averaged *before* deciding: the structure tensor of the logarithm of
brightness, at growing scales, each pixel taking the finest whose tensor is clearly elongated. Rendered hair with path
tracing noise, where single ridges drown, still gives its direction within some 5° this way.

A picture does not tell forth from back: hair is taken to run away from the crown and downwards, and where that says
nothing (across), as its surroundings do.

Limits: hair combed up from the forehead gets the wrong sense; its orientation is right all the same.
"""

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from tress.base.params import Params, param

Array = np.ndarray[Any, Any]

SHADE = 0.02
"""Added to brightness before its logarithm: what is darker counts as black."""


@dataclass(frozen=True)
class FlowParams(Params):
    """Settings of the dense flow."""

    gradient_px: float = param(1.2, low=0.3, high=10.0, unit="px", doc="Blur under which slopes are taken.")
    finest_mm: float = param(2.0, low=0.1, high=20.0, unit="mm", doc="Blur of the finest average.")
    scales: int = param(4, low=1, high=8, doc="Number of scales, each twice as wide.")
    clear: float = param(0.7, low=0.01, high=1.0, doc="Elongation of the tensor from which a scale is taken.")
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
    brightness: Array,
    *,
    alpha: Array,
    hair: Array,
    crown_px: Array,
    px_per_metre: float,
    params: FlowParams = FlowParams(),
) -> HairFlow:
    """From `brightness` (H, W) in [0, 1], opacity `alpha` (H, W), the pixels of `hair` (H, W) bool and the crown's
    pixel (2,).

    Works in the box around the hair: about 0.1 s for 500 x 500 px.
    """
    direction, trust = np.zeros((*hair.shape, 2), np.float32), np.zeros(hair.shape, np.float32)
    if not hair.any():
        return HairFlow(direction, trust)
    rows, columns = (np.nonzero(hair.any(axis=k))[0] for k in (1, 0))
    box = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    axis, elongation = _axes(brightness[box], alpha[box], px_per_metre, params)
    corner = np.array([columns[0], rows[0]])
    signed = _with_sense(axis, crown_px - corner, hair[box], px_per_metre, params)
    direction[box] = signed * hair[box][..., None]
    trust[box] = elongation * hair[box]
    return HairFlow(direction, trust)


def _axes(brightness: Array, alpha: Array, px_per_metre: float, params: FlowParams) -> tuple[Array, Array]:
    """Undirected unit axis (H, W, 2) and elongation (H, W) of the structure tensor, finest clear scale first."""
    image = cv2.GaussianBlur(np.log(np.asarray(brightness, np.float32) + SHADE), (0, 0), params.gradient_px)
    dx, dy = cv2.Sobel(image, cv2.CV_32F, 1, 0, ksize=3), cv2.Sobel(image, cv2.CV_32F, 0, 1, ksize=3)
    inner = cv2.erode((alpha > 0.5).astype(np.float32), np.ones((5, 5), np.uint8)) + np.float32(1e-3)
    data = np.dstack([(dy * dy - dx * dx) * inner, -2 * dx * dy * inner, (dx * dx + dy * dy) * inner])
    sigma = params.finest_mm * 1e-3 * px_per_metre
    data = data / (_blurred(data[..., 2], 4 * sigma)[..., None] + 1e-12)
    doubled, elongation = np.zeros_like(data[..., :2]), np.zeros_like(data[..., 0])
    left = np.ones_like(elongation)
    for number in range(params.scales):
        mean = _blurred(data, sigma * 2**number)
        length = np.linalg.norm(mean[..., :2], axis=-1)
        clear = length / np.maximum(mean[..., 2], 1e-12)
        last = number == params.scales - 1
        share = left if last else left * np.clip(clear / params.clear, 0, 1) ** 2
        doubled += (share / np.maximum(length, 1e-12))[..., None] * mean[..., :2]
        elongation += share * clear
        left = left - share
    half = np.arctan2(doubled[..., 1], doubled[..., 0]) / 2
    return np.dstack([np.cos(half), np.sin(half)]), np.clip(elongation, 0, 1)


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
