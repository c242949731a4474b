"""Light on strips of hair: a soft body, and two highlights across the flow.

The body is diffuse light between that of a fibre (Kajiya and Kay) and that of a surface; the highlights are those of a
fibre whose direction is tilted towards the normal, so that they move along the hair: the first has the colour of the
light and lies nearer to the tip, the second has that of the hair and lies nearer to the root.

Source: Kajiya and Kay, Rendering Fur with Three Dimensional Textures (1989); Scheuermann, Practical Real-Time Hair
Rendering and Shading (2004).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

WRAP = 0.3
"""How far diffuse light reaches around to the side away from it."""
LEAST = 0.12
"""Of the sky's light, what is scattered from hair to hair into the depths."""
SECOND = 0.35
"""Exponent of the second highlight, as a share of that of the first."""


@dataclass(frozen=True, eq=False)
class StripSurface:
    """K places of hair: `color` (K, 3) linear; unit `normal` towards the viewer and `along` root to tip (K, 3);
    `sky` and `light` (K,), the shares of both that reach them; `shift` (K,), how far highlights move to the tip."""

    color: Array
    normal: Array
    along: Array
    sky: Array
    light: Array
    shift: Array


@dataclass(frozen=True)
class Gloss:
    """Strengths of the first and the second highlight, the first's exponent, and the tilt of the fibre between them."""

    first: float
    second: float
    exponent: float
    tilt: float


def lit_strips(
    surface: StripSurface, *, to_light: Array, to_eye: Array, gloss: Gloss, light: float, sky: float
) -> Array:
    """(K, 3) float32: light that leaves towards the viewer."""
    half = to_light + to_eye
    half = half / max(float(np.linalg.norm(half)), 1e-9)
    facing = surface.normal @ to_light
    body = np.clip((facing + WRAP) / (1 + WRAP), 0, 1) * (0.5 + 0.5 * _sine(surface.along @ to_light))
    round_about = LEAST + (1 - LEAST) * surface.sky
    out = surface.color * (sky * round_about + light * surface.light * body)[:, None]
    lit = light * surface.light * np.clip((facing + WRAP) / (1 + WRAP), 0, 1)
    first = highlight(surface, half=half, shift=surface.shift + gloss.tilt, exponent=gloss.exponent)
    second = highlight(surface, half=half, shift=surface.shift - gloss.tilt, exponent=SECOND * gloss.exponent)
    out += (gloss.first * lit * first)[:, None]
    out += surface.color * (gloss.second * lit * second)[:, None]
    return out.astype(np.float32)


def highlight(surface: StripSurface, *, half: Array, shift: Array, exponent: float) -> Array:
    """(K,) in [0, 1]: the highlight of fibres with their directions shifted by `shift` times the normal.

    It is largest where `along + shift normal` is square to the `half` vector: a positive shift moves it
    to the tip, where hair bends away from the viewer.
    """
    tilted = surface.along + shift[:, None] * surface.normal
    tilted = tilted / np.linalg.norm(tilted, axis=1, keepdims=True).clip(1e-9)
    return _sine(tilted @ half) ** exponent


def _sine(cosine: Array) -> Array:
    return np.sqrt(np.maximum(1 - cosine * cosine, 0))
