"""Patches with closed forms."""

import numpy as np

from tress.kernel.curves import curve
from tress.kernel.nurbs import Patch, patch

HALF = np.sqrt(0.5)
ARC_WEIGHTS = np.array([1, HALF, 1, HALF, 1])
HALF_CIRCLE = curve(
    [[0, 0, -1], [1, 0, -1], [1, 0, 0], [1, 0, 1], [0, 0, 1]],
    degree=2,
    weights=ARC_WEIGHTS,
    knots=[0, 0, 0, 1, 1, 2, 2, 2],
)
"""From the lower to the upper pole."""
ROUND = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)], float)
ROUND_WEIGHTS = np.array([1, HALF, 1, HALF, 1, HALF, 1, HALF, 1])
ROUND_KNOTS = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]


def plane() -> Patch:
    """x = 2 u, y = 3 v, z = 0.5 over the unit square, bicubic: control points at the Greville parameters."""
    x, y = np.meshgrid(np.array([0, 1 / 6, 0.5, 5 / 6, 1]) * 2, np.arange(4.0), indexing="ij")
    return patch(np.stack([x, y, np.full_like(x, 0.5)], axis=-1))


def cylinder(height=2.0) -> Patch:
    """Radius 1 about the z axis: u round it from the x axis towards y, v upwards."""
    net = np.array([[(x, y, z) for z in (0.0, height)] for x, y in ROUND])
    weights = np.repeat(ROUND_WEIGHTS[:, None], 2, axis=1)
    return patch(net, degree_u=2, degree_v=1, weights=weights, knots_u=ROUND_KNOTS)


def sphere() -> Patch:
    """Radius 1: u from the upper pole (z = 1) to the lower, v round it from the x axis towards y; normals outwards."""
    net = np.array([[(px * x, px * y, pz) for x, y in ROUND] for px, _, pz in HALF_CIRCLE.points[::-1]])
    weights = ARC_WEIGHTS[:, None] * ROUND_WEIGHTS
    knots = {"knots_u": HALF_CIRCLE.knots, "knots_v": ROUND_KNOTS}
    return patch(net, degree_u=2, degree_v=2, weights=weights, **knots)
