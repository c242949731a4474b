"""How wavy the hair in the photograph is, and waves of that strength for the hair that it does not show.

The angle between the picture's flow and its own mean over a centimetre says how far strands wind about their way.
Hidden directions are turned by a smooth random field with that spread, so that locks behind look like those before.
"""

from typing import Any

import cv2
import numpy as np

from tress.kernel import fields
from tress.methods.portrait.flow import HairFlow

Array = np.ndarray[Any, Any]

MEAN_MM = 6.0
"""Blur over which the mean flow is taken."""
NOISE = 0.07
"""Radians by which the flow of straight hair strays, from the grain of the picture."""
WILDEST = 0.6
"""Radians of the strongest waves that are put on."""
LOCK = 0.012
"""Metres over which waves turn."""


def waviness(flow: HairFlow, *, px_per_metre: float) -> float:
    """Radians in [0, WILDEST]: root mean square of the angle between the flow and its mean near by, where trusted."""
    step = max(1, int(1e-3 * px_per_metre))
    direction, trust = flow.direction[::step, ::step], flow.trust[::step, ::step]
    weight = trust * (np.abs(direction).sum(axis=-1) > 0)
    if weight.sum() <= 0:
        return 0.0
    sigma = max(0.5, MEAN_MM * 1e-3 * px_per_metre / step)
    mean = cv2.GaussianBlur((direction * weight[..., None]).astype(np.float32), (0, 0), sigma)
    mean /= np.maximum(np.linalg.norm(mean, axis=-1, keepdims=True), 1e-9)
    cosine = np.clip(np.abs((direction * mean).sum(axis=-1)), 0, 1)
    angle = float(np.sqrt((weight * np.arccos(cosine) ** 2).sum() / weight.sum()))
    return float(np.clip(angle - NOISE, 0, WILDEST))


def waves(places: Array, *, shape: tuple[int, ...], lock: float, seed: int) -> Array:
    """(N, 3) float32: a smooth random field around 0, mostly within 1, at `places` (N, 3) of a box of `shape` voxels.

    `places` hold column, row, layer; `lock` is the distance, in voxels, over which the field turns.
    """
    coarse = tuple(int(np.ceil(size / lock)) + 2 for size in shape)
    random = np.random.default_rng(seed).normal(size=(3, *coarse)).astype(np.float32)
    return np.stack([fields.sample(part, places=np.asarray(places) / lock + 0.5) for part in random], axis=1)
