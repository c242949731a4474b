"""A cap over the scalp, so that no skin shows between clumps."""

from typing import Any

import numpy as np

from tress.kernel.curves import uniform_knots
from tress.methods.cartoon.skull import Skull
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

ROWS, COLUMNS = 14, 32
EDGE = 0.04
"""Radians that the cap ends before the hairline."""


def scalp_cap(skull: Skull, *, lift_m: float = 0.0035, group: str = "") -> Strip:
    """A surface `lift_m` above the scalp, u from the crown down to the hairline, v round the head, closed.

    Its control points lie in directions from the middle of the head, so it has neither folds nor overhangs.
    """
    azimuth = np.linspace(0, 2 * np.pi, COLUMNS, endpoint=False)
    edge = _smooth(skull.hairline(azimuth)) - EDGE
    polar = np.linspace(0.0, 1.0, ROWS)[:, None] * edge
    points = skull.scalp(azimuth, polar)[0]
    away = points / np.linalg.norm(points, axis=-1, keepdims=True)
    net = points + lift_m * away
    net = np.concatenate([net, net[:, :3]], axis=1)
    return Strip(
        points=net,
        weights=np.ones(net.shape[:2]),
        knots_u=uniform_knots(ROWS, degree=3),
        knots_v=np.arange(COLUMNS + 7.0),
        group=group,
    )


def _smooth(edge: Array) -> Array:
    """Closed (V,) without single peaks: the middle of each five, then a mean of three."""
    middle = np.median([np.roll(edge, shift) for shift in (-2, -1, 0, 1, 2)], axis=0)
    return (np.roll(middle, 1) + 2 * middle + np.roll(middle, -1)) / 4
