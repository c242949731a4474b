"""Strips to copy: flat ones bowed, waved and rounded a little, as `attach` takes them (x along, y across, z out)."""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.model.strip import Strip
from tress.model.strip_shapes import flat_strip

Array = np.ndarray[Any, Any]

LEAST_BOW, SKULL_M = 0.12, 0.09


def lock(
    *,
    length_m: float,
    width_m: float,
    root_width: float = 0.75,
    tip_width: float = 0.45,
    bow: float | None = None,
    rows: int = 8,
    columns: int = 4,
) -> Strip:
    """A lock of hair: widest a third of the way along, `root_width` and `tip_width` of that at its ends.

    Its middle stands out above its edges by a quarter of `bow` times the width; by default as the skull does under a
    strip of that width, and at least a little.
    """
    bow = max(LEAST_BOW, width_m / (2 * SKULL_M)) if bow is None else bow
    strip = flat_strip(length_m=length_m, width_m=1.0, rows=rows, columns=columns)
    t = np.linspace(0, 1, rows)[:, None]
    profile = np.where(
        t < 1 / 3, root_width + (1 - root_width) * smooth(3 * t), 1 - (1 - tip_width) * smooth(1.5 * t - 0.5)
    )
    points = strip.points.copy()
    across = points[..., 1]
    points[..., 1] = width_m * profile * across
    points[..., 2] = bow * width_m * profile * (0.25 - across**2)
    return replace(strip, points=points)


def waved(strip: Strip, *, height_m: float, waves: float, phase_rad: float = 0.0, from_share: float = 0.2) -> Strip:
    """The strip in `waves` along its length, within its plane and half as high out of it, from `from_share` on."""
    points = strip.points.copy()
    length = points[..., 0].max()
    t = points[..., 0] / length
    height = height_m * smooth((t - from_share) / 0.3)
    angle = 2 * np.pi * waves * t + phase_rad
    points[..., 1] += height * np.cos(angle)
    points[..., 2] += 0.5 * height * np.sin(angle)
    return replace(strip, points=points)


def smooth(x: Any) -> Any:
    """0 up to 0, 1 from 1 on, without a kink between."""
    t = np.clip(x, 0, 1)
    return t * t * (3 - 2 * t)


def turned_in(strip: Strip, *, depth_m: float, from_share: float = 0.55) -> Strip:
    """The strip with its tip bent towards the head, from a share of its length on."""
    points = strip.points.copy()
    t = points[..., 0] / points[..., 0].max()
    points[..., 2] -= depth_m * np.clip((t - from_share) / (1 - from_share), 0, 1) ** 2
    return replace(strip, points=points)
