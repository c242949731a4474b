"""The closed curve that is swept along a key hair."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.kernel import curves
from tress.kernel.arrays import checked
from tress.kernel.curves import Curve

Array = np.ndarray[Any, Any]

_CHECKED = 240
"""Points at which a profile is looked at for crossings."""


@dataclass(frozen=True, eq=False)
class Profile:
    """A closed rational B-spline in the plane across a hair: x to the side (R), y along the normal (N), in radii.

    `points` (Q, 2) float64 and `weights` (Q,), with `knots` (Q + degree + 1,); it runs counter-clockwise.
    """

    points: Array
    weights: Array
    knots: Array
    degree: int

    def at(self, count: int) -> Array:
        """(count, 2) points at even parameters, once round."""
        flat = Curve(np.column_stack([self.points, np.zeros(len(self.points))]), self.weights, self.knots, self.degree)
        low, high = self.knots[self.degree], self.knots[-self.degree - 1]
        return curves.evaluate(flat, at=low + (high - low) * np.arange(count) / count)[:, :2]


def ellipse() -> Profile:
    """The exact circle of one radius, an ellipse once the radii are put to it; starts at the side.

    >>> bool(np.allclose(np.hypot(*ellipse().at(50).T), 1))
    True
    """
    corner = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    weights = np.where(np.arange(9) % 2, np.sqrt(0.5), 1.0)
    return Profile(np.array(corner, float), weights, np.array([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]) / 4, 2)


def closed_spline(points: Any) -> Profile:
    """The closed cubic B-spline of drawn control `points` (K, 2), K >= 3.

    Raises `InputError` for fewer points, numbers that are not finite, and a curve that crosses itself.
    """
    drawn = _counter_clockwise(_drawn(points))
    wrapped = np.concatenate([drawn, drawn[:3]])
    return _uncrossed(Profile(wrapped, np.ones(len(wrapped)), np.arange(len(wrapped) + 4.0), 3))


def polygon(points: Any) -> Profile:
    """The closed polyline through drawn corners (K, 2), K >= 3. Raises `InputError` as `closed_spline` does."""
    drawn = _counter_clockwise(_drawn(points))
    closed = np.concatenate([drawn, drawn[:1]])
    knots = np.concatenate([[0], np.arange(len(closed)), [len(closed) - 1.0]])
    return _uncrossed(Profile(closed, np.ones(len(closed)), knots, 1))


def alike(first: Profile, second: Profile, *, count: int = 16) -> tuple[Profile, Profile]:
    """Two profiles as closed cubics of `count` control points each, so that one can turn into the other.

    They pass through `count` points of what they stand for, at even lengths from the one that is farthest to the side.
    """
    return _through(first, count), _through(second, count)


def _through(profile: Profile, count: int) -> Profile:
    fine = profile.at(_CHECKED)
    fine = np.roll(fine, -int(np.argmax(fine[:, 0])), axis=0)
    round_trip = np.concatenate([fine, fine[:1]])
    way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(round_trip, axis=0), axis=1))])
    stops = np.arange(count) / count * way[-1]
    wanted = np.column_stack([np.interp(stops, way, round_trip[:, axis]) for axis in (0, 1)])
    rows = np.arange(count)
    system = np.zeros((count, count))
    for shift, share in ((0, 1 / 6), (1, 4 / 6), (2, 1 / 6)):
        system[rows, (rows + shift) % count] = share
    control = np.linalg.solve(system, wanted)
    wrapped = np.concatenate([control, control[:3]])
    return Profile(wrapped, np.ones(len(wrapped)), np.arange(len(wrapped) + 4.0), 3)


def _drawn(points: Any) -> Array:
    drawn = checked(points, name="profile", dtype=np.float64, shape=(None, 2))
    if len(drawn) > 1 and np.allclose(drawn[0], drawn[-1]):
        drawn = drawn[:-1]
    if len(drawn) < 3 or abs(_area(drawn)) < 1e-12:
        raise InputError(f"The profile has {len(drawn)} points; 3 or more that enclose an area were expected.")
    return drawn


def _area(points: Array) -> float:
    x, y = points.T
    return float(0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _counter_clockwise(points: Array) -> Array:
    return points if _area(points) > 0 else points[::-1]


def _uncrossed(profile: Profile) -> Profile:
    around = profile.at(_CHECKED)
    if profile.degree == 1:
        around = profile.points[:-1]
    crossing = _crossing(around)
    if crossing is not None:
        x, y = crossing
        raise InputError(f"The profile crosses itself near ({x:.3g}, {y:.3g}); a curve that does not was expected.")
    return profile


def _crossing(points: Array) -> Array | None:
    """The place (2,) where a closed polyline (K, 2) crosses itself, or None."""
    start, end = points, np.roll(points, -1, axis=0)

    def side(p: Array, q: Array, r: Array) -> Array:
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])

    a, b, c, d = start[:, None], end[:, None], start[None], end[None]
    apart = (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)
    found = np.argwhere(apart)
    return points[found[0, 0]] if len(found) else None
