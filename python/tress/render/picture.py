"""From a GBuffer and a style to a picture."""

from typing import Any

import numpy as np

from tress.base.color import linear_to_srgb8
from tress.kernel import raster
from tress.render.gbuffer import GBuffer
from tress.render.style import LineStyle, Style

Array = np.ndarray[Any, Any]


def premultiplied_rgba(gbuffer: GBuffer, *, style: Style, hold_out_meshes: bool = False) -> Array:
    """(H, W, 4) float32 linear, premultiplied, blended in linear light.

    With `hold_out_meshes`, meshes hide strands but are themselves empty: the hair alone, ready to lie over a picture,
    without the lines that a style may draw over it.
    """
    rgba = style.shade(gbuffer)
    if hold_out_meshes:
        rgba[gbuffer.fragments.kind == raster.TRIANGLE, 3] = 0
    picture = raster.composite(gbuffer.fragments, rgba=rgba)
    if isinstance(style, LineStyle) and not hold_out_meshes:
        lines = style.drawn_lines(gbuffer)
        return lines + (1 - lines[..., 3:]) * picture
    return picture


def straight_rgba(premultiplied: Array) -> Array:
    """(H, W, 4) float32 linear with straight alpha; colour 0 where nothing is."""
    alpha = premultiplied[..., 3:]
    color = np.divide(premultiplied[..., :3], alpha, out=np.zeros_like(premultiplied[..., :3]), where=alpha > 0)
    return np.concatenate([color, alpha], axis=-1)


def over(premultiplied: Array, *, background: Array) -> Array:
    """(H, W, 3) float32 linear: the picture over a linear `background`, a colour (3,) or a picture (H, W, 3)."""
    return premultiplied[..., :3] + (1 - premultiplied[..., 3:]) * np.asarray(background, np.float32)


def srgb_rgb(premultiplied: Array, *, background: Array) -> Array:
    """(H, W, 3) uint8 sRGB: the picture over a linear background."""
    return linear_to_srgb8(over(premultiplied, background=background))


def srgb_rgba(premultiplied: Array) -> Array:
    """(H, W, 4) uint8, sRGB colour with straight linear alpha, as PNG keeps it."""
    straight = straight_rgba(premultiplied)
    alpha = np.clip(straight[..., 3:], 0, 1) * 255 + 0.5
    return np.concatenate([linear_to_srgb8(straight[..., :3]), alpha.astype(np.uint8)], axis=-1)
