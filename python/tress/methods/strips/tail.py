"""A tail of hair: locks about one axis, which leaves the head and turns down, and the band that holds them.

Patterns for `attach`: x down along the surface, y across, z out of it.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tress.methods.strips.patterns import smooth
from tress.model.strip import Strip
from tress.model.strip_shapes import flat_strip

Array = np.ndarray[Any, Any]

STEPS = 200
WIDEST_RAD = 1.3
"""No lock reaches further around the axis to either side."""
BAND_M, BAND_RAD, OVER_BAND = 0.012, 1.9, 1.12
"""Length of the band along the axis, the angle of one piece of it, and its radius as a multiple of the tail's there."""


@dataclass(frozen=True)
class Tail:
    """Metres: its length, the radius at the tie and where it is thickest, the height of the tie above the surface, and
    the way over which it turns down. `lean_rad` is the angle by which the surface faces up there."""

    length_m: float
    tie_m: float = 0.0105
    thick_m: float = 0.027
    height_m: float = 0.005
    bend_m: float = 0.032
    lean_rad: float = 0.31

    def axis(self, way_m: Array) -> tuple[Array, Array]:
        """(N, 3) points of the axis that far along it, and (N, 3) its unit directions."""
        fine = np.linspace(0, 1.1 * self.length_m, STEPS)
        angle = (np.pi / 2 + self.lean_rad) * (1 - np.exp(-((fine / self.bend_m) ** 1.5)))
        direction = np.stack([np.sin(angle), np.zeros(STEPS), np.cos(angle)], axis=1)
        points = np.concatenate([np.zeros((1, 3)), np.cumsum(direction[:-1] * np.diff(fine)[:, None], axis=0)])
        points[:, 2] += self.height_m
        at = [np.stack([np.interp(way_m, fine, part[:, k]) for k in range(3)], axis=1) for part in (points, direction)]
        return at[0], at[1] / np.linalg.norm(at[1], axis=1, keepdims=True)

    def radius(self, share: Array) -> Array:
        """(N,) metres at shares of the length: from the tie swelling, then tapering to the tip."""
        swell = self.tie_m + (self.thick_m - self.tie_m) * smooth((share - 0.04) / 0.3)
        return swell * (1 - 0.8 * smooth((share - 0.35) / 0.75))


def tail_lock(
    tail: Tail, *, angle_rad: float, shell: float, width_m: float, length: float = 1.0, rows: int = 14
) -> Strip:
    """A lock at an angle about the axis, at `shell` of the tail's radius, of a share of its length."""
    share = np.linspace(0, length, rows)
    profile = 0.55 + 0.45 * smooth(share / 0.25) - 0.55 * smooth((share / length - 0.5) / 0.5)
    radius = shell * tail.radius(share)
    half = np.minimum(0.5 * width_m * profile / radius, WIDEST_RAD)
    turns = angle_rad + 0.25 * np.sin(2 * np.pi * share + 3 * angle_rad)
    angle = turns[:, None] + half[:, None] * np.linspace(-1, 1, 4)
    centre, along = tail.axis(share * tail.length_m)
    return _around(centre[:, None], along[:, None], radius[:, None], angle)


def band(tail: Tail, *, angle_rad: float) -> Strip:
    """A piece of the band around the roots of the tail."""
    angle = (angle_rad + np.linspace(0, BAND_RAD, 6))[:, None]
    centre, along = tail.axis(np.linspace(BAND_M, 0, 4))
    return _around(centre[None], along[None], OVER_BAND * np.full((1, 1), tail.tie_m), np.repeat(angle, 4, axis=1))


def _around(centre: Array, along: Array, radius: Array, angle: Array) -> Strip:
    """A strip with control points at these angles and radii about an axis with points and directions (U, V, 3)."""
    down = np.stack([-along[..., 2], np.zeros(along.shape[:-1]), along[..., 0]], axis=-1)
    aside = np.array([0.0, 1.0, 0.0])
    ray = np.cos(angle)[..., None] * down + np.sin(angle)[..., None] * aside
    points = centre + radius[..., None] * ray
    plain = flat_strip(length_m=1.0, width_m=1.0, rows=points.shape[0], columns=points.shape[1])
    return replace(plain, points=points)
