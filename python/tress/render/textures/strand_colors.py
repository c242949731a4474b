"""Colours along the strands of a card."""

from typing import Any

import numpy as np

from tress.render.textures.card_strands import HALF_DEPTH, CardStrands
from tress.render.textures.params import TextureParams

Array = np.ndarray[Any, Any]

_BRIGHTNESS = 0.55
"""Spread of the strands' brightness (of its logarithm) at full variation."""
_LOCK_BRIGHTNESS = 0.25
_HUE = np.array([0.12, 0.0, -0.18])
"""Warmer in red, less blue."""


def strand_colors(strands: CardStrands, *, params: TextureParams, random: np.random.Generator) -> Array:
    """(S, P, 3) float64 linear: from the root's to the tip's colour, varied by lock and strand, darker in the depth."""
    count = len(strands.points)
    share = (strands.t**0.9)[..., None]
    gradient = np.asarray(params.root_color) * (1 - share) + np.asarray(params.tip_color) * share
    by_lock = random.normal(0, _LOCK_BRIGHTNESS, strands.lock.max() + 1)[strands.lock]
    brightness = np.exp(params.color_variation * (random.normal(0, _BRIGHTNESS, count) + by_lock))
    hue = np.exp(params.color_variation * random.normal(0, 1, count)[:, None] * _HUE)
    nearness = 0.5 + 0.5 * strands.points[..., 2] / HALF_DEPTH
    shade = 1 - params.depth_shading * (1 - np.clip(0.15 + nearness, 0, 1)) ** 1.2
    return gradient * (brightness[:, None] * hue)[:, None] * shade[..., None]
