"""Clumps that split towards the tip, or merge there."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.params import Params, param
from tress.methods.cartoon.frames import frames
from tress.methods.cartoon.key_hairs import KeyHairs

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class SplitParams(Params):
    """One key hair becomes several; 0 apart at the root, 1 or more at the tip, is a split; the reverse is a merger."""

    ways: int = param(1, low=1, high=100, doc="Clumps of one key hair.")
    apart_root: float = param(0.0, low=0.0, high=10.0, doc="How far the outermost go aside at the root, in radii.")
    apart_tip: float = param(1.2, low=0.0, high=10.0, doc="How far the outermost go aside at the tip, in radii.")
    begins: float = param(0.4, low=0.0, high=0.99, doc="Part of the length after which they go apart.")
    slimmer: float = param(0.75, low=0.01, high=1.0, doc="Radii of each, as part of those of an undivided clump.")
    shorter: float = param(0.15, low=0.0, high=0.9, doc="How much shorter the outermost are than the middle.")


def split(hairs: KeyHairs, *, params: SplitParams, radius: Array | float) -> KeyHairs:
    """n times `ways` hairs, those of one key hair one after the other; `radius` in metres, one or (n,).

    They go apart across the hair, R, by a smooth curve from where the splitting begins, so that two that part begin in
    one direction; none leaves the plane of D and R, so that they fan out as the surface does.
    """
    if params.ways == 1:
        return hairs
    side = np.linspace(-1, 1, params.ways)
    part = np.linspace(0, 1, hairs.points.shape[1])
    at = part[None] * (1 - params.shorter * np.abs(side))[:, None]
    points, normals = (_along(values, at) for values in (hairs.points, hairs.normals))
    across = _along(frames(hairs.points, normals=hairs.normals).across, at)
    into = np.clip((at - params.begins) / (1 - params.begins), 0, 1)
    apart = params.apart_root + (params.apart_tip - params.apart_root) * into**2 * (3 - 2 * into)
    wide = np.broadcast_to(radius, len(hairs.points))[:, None, None]
    shifted = points + (wide * (side[:, None] * apart))[..., None] * across
    return KeyHairs(*(values.reshape(-1, *values.shape[2:]) for values in (shifted, normals)))


def _along(values: Array, at: Array) -> Array:
    """(n, k, p, C) of values (n, p, C) at parts of the length (k, p)."""
    place = at * (values.shape[1] - 1)
    first = np.minimum(place.astype(np.int64), values.shape[1] - 2)
    share = (place - first)[..., None]
    return values[:, first] * (1 - share) + values[:, first + 1] * share
