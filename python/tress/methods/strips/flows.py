"""Flow fields: which way hair is combed at a point of space. Each is a function that makes one; they add up."""

from typing import Any

import numpy as np

from tress.edit.comb import Flow

Array = np.ndarray[Any, Any]

SHARP_M = 0.002
"""Half the width of a parting."""


def steady(direction: Any) -> Flow:
    """The same way everywhere; a length above 1 weighs more in a sum."""
    vector = np.asarray(direction, np.float64)
    return lambda points: np.broadcast_to(vector, points.shape)


def parted(x_m: float = 0.0, *, back: float = 0.0, below_m: float = 0.02, end_z_m: float = -0.035) -> Flow:
    """To both sides of a parting line on top of the head, at `x_m`, and a share of it to the `back`.

    Behind its end, `end_z_m` metres before the head's middle, hair falls away from that end to all sides, without a
    seam. The way aside fades out on the way down, from the crown to the height `below_m`.
    """

    def flow(points: Array) -> Array:
        aside, behind = points[:, 0] - x_m, np.minimum(points[:, 2] - end_z_m, 0)
        aside = np.where(np.abs(aside) < SHARP_M, np.where(aside >= 0, SHARP_M, -SHARP_M), aside)
        reach = 0.06 + 0.04 * np.clip(-points[:, 2] / 0.03, 0, 1)
        above = np.clip((points[:, 1] - below_m) / reach, 0, 1) / np.hypot(aside, behind)
        zero = np.zeros(len(points))
        forward = np.clip((points[:, 2] - end_z_m) / 0.04, 0, 1) * back * np.hypot(aside, behind)
        return np.stack([aside * above, zero, (behind - forward) * above], axis=1)

    return flow


def over_the_ears(*, x_m: float = 0.09) -> Flow:
    """Outwards above the ears, so that hair falls over them and not through: to `x_m` on either side."""

    def flow(points: Array) -> Array:
        x, y, z = points.T
        beside = np.clip((x_m - np.abs(x)) / 0.008, 0, 1) * np.clip((np.abs(x) - 0.05) / 0.01, 0, 1)
        height = np.clip((0.04 - y) / 0.01, 0, 1) * np.clip((y + 0.06) / 0.01, 0, 1)
        there = beside * height * np.clip((0.035 - np.abs(z + 0.005)) / 0.01, 0, 1)
        return np.stack([np.sign(x) * there, np.zeros(len(x)), np.zeros(len(x))], axis=1)

    return flow


def up_before_the_ears(*, top_m: float = 0.035, weight: float = 1.5) -> Flow:
    """Up beside and before the ears, so that hair that is swept back goes over them and not across."""

    def flow(points: Array) -> Array:
        x, y, z = points.T
        beside = np.clip((np.abs(x) - 0.055) / 0.01, 0, 1) * np.clip((top_m - y) / 0.02, 0, 1)
        there = weight * beside * np.clip((z + 0.04) / 0.015, 0, 1)
        zero = np.zeros(len(x))
        return np.stack([zero, there, zero], axis=1)

    return flow


def inwards(*, below_m: float = -0.05, weight: float = 0.6, centre_z_m: float = -0.02) -> Flow:
    """To the neck, below a height: tips that turn in."""

    def flow(points: Array) -> Array:
        way = np.stack([-points[:, 0], np.zeros(len(points)), centre_z_m - points[:, 2]], axis=1)
        below = np.clip((below_m - points[:, 1]) / 0.04, 0, 1)
        return weight * below[:, None] * way / np.linalg.norm(way, axis=1, keepdims=True).clip(0.02)

    return flow


def whorl(centre: Any, *, swirl: float = 0.6, reach_m: float = 0.1) -> Flow:
    """Away from a point of the scalp, turned about it by `swirl` (counter-clockwise from outside), fading."""
    middle = np.asarray(centre, np.float64)
    axis = middle / np.linalg.norm(middle)

    def flow(points: Array) -> Array:
        way = points - middle
        away = way - (way @ axis)[:, None] * axis
        distance = np.linalg.norm(away, axis=1, keepdims=True).clip(1e-9)
        return (away + swirl * np.cross(axis, away)) / distance * np.exp(-((distance / reach_m) ** 2))

    return flow


def towards(target: Any, *, reach_m: float = 0.02) -> Flow:
    """To a point, as to the tie of a ponytail; it fades within `reach_m`, so that hair does not turn round there."""
    place = np.asarray(target, np.float64)

    def flow(points: Array) -> Array:
        way = place - points
        return way / np.linalg.norm(way, axis=1, keepdims=True).clip(reach_m)

    return flow


def off_the_face(*, z_m: float = 0.035, below_m: float = 0.05) -> Flow:
    """Aside and back wherever hair would hang over the face."""

    def flow(points: Array) -> Array:
        x, y, z = points.T
        before = np.clip((z - z_m) / 0.02, 0, 1) * np.clip((below_m - y) / 0.03, 0, 1)
        return np.stack([np.sign(x) * before, np.zeros(len(x)), -before], axis=1)

    return flow


def around_the_shoulders(*, split_m: float = 0.02, below_m: float = -0.08) -> Flow:
    """Before the shoulders or behind them, from the neck on: hair with z above `split_m` forwards, the rest back."""

    def flow(points: Array) -> Array:
        from_split = points[:, 2] - split_m
        side = np.where(from_split > 0, 1.0, -1.0) * (0.15 + 0.45 * np.exp(-np.abs(from_split) / 0.03))
        below = np.clip((below_m - points[:, 1]) / 0.03, 0, 1) * np.clip((points[:, 1] + 0.22) / 0.05, 0, 1)
        zero = np.zeros(len(points))
        return np.stack([zero, zero, side * below], axis=1)

    return flow


def added(*flows: Flow) -> Flow:
    """The sum of flows."""
    return lambda points: np.sum([flow(points) for flow in flows], axis=0)
