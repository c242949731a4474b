"""Giving hair another colour and keeping its light and shade."""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.base.color import luminance
from tress.base.errors import InputError
from tress.edit.lookup import strands_named
from tress.model.diff import Diff
from tress.model.document import Document

Array = np.ndarray[Any, Any]


def recolour(document: Document, *, name: str, color: tuple[float, float, float], variation: float = 1.0) -> Diff:
    """Gives the strands `name` the linear RGB `color` on average.

    `variation` says how much of the old differences in luminance stays: 1 all, 0 none. Every point gets the hue of
    `color`; strands without colour get it plain. Raises `InputError` where there are no such strands, or `color` is not
    three numbers of 0 or more.
    """
    target = np.array(color, np.float64)
    if target.shape != (3,) or not np.isfinite(target).all() or target.min() < 0:
        raise InputError(f"Colour {color!r}: three numbers of 0 or more were expected.")
    before = strands_named(document, name)
    shade = _shade(before.point_attributes.get("color"), len(before.points))
    values = target * (1 + variation * (shade - 1))[:, None]
    after = replace(before, point_attributes={**before.point_attributes, "color": np.maximum(values, 0)})
    return Diff(updated={name: (before, after)})


def _shade(color: Array | None, count: int) -> Array:
    """(N,) luminance of each point over the mean; 1 where there is no light to speak of."""
    if color is None or not count:
        return np.ones(count)
    light = luminance(color).astype(np.float64)
    mean = light.mean()
    return light / mean if mean > 1e-9 else np.ones(count)
