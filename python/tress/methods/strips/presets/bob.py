"""A bob: cut to one line below the chin, the tips turned in, with a fringe."""

from typing import Any

import numpy as np

from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.cap import with_cap
from tress.methods.strips.ending_at import bands_ending_at
from tress.methods.strips.even_roots import EvenRoots, above_the_ears, even_roots
from tress.methods.strips.flows import added, inwards, off_the_face, over_the_ears, parted, steady
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock, turned_in
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

CROWN_Z_M = -0.015
"""From where the hair falls to all sides, and the fringe forwards."""
FALL = added(
    steady((0, -1, 0)),
    parted(0.0, back=0.2, end_z_m=CROWN_Z_M),
    over_the_ears(),
    off_the_face(z_m=0.05),
    inwards(weight=0.8),
)
FRINGE_FALL = steady((0, -1, 0.5))
ROW_M, BROW_WAY_M = 0.01, 0.125
"""The fringe is of one length in rows; the way to the brows from above the head's middle."""
LINE_M = -0.105
"""Height of the cut."""
LAYERS = (("under", 0.26, 0.034, 0.004), ("middle", 0.24, 0.026, 0.006), ("over", 0.17, 0.017, 0.008))
"""Group, share of the strips, width and lift in metres."""
FRINGE, CROWN = 0.2, 0.08
"""Shares of the strips over the forehead, and about the crown, over the beginnings of all others."""
EVEN = Variation(turn_low=-0.1, turn_high=0.1, tilt_high=0.03, length_low=0.97, length_high=1.03)


def bob(document: Document, params: StripsParams) -> Document:
    """Chin length with a fringe, the tips turned in."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    document = with_cap(document, params)
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=_beside_the_fringe)
        document = with_layer(
            document,
            into=name,
            patterns=_cut(roots, params, width_m),
            flow=FALL,
            variation=EVEN,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            rise_m=0.04,
        )
    at_crown = even_roots(mesh, count=params.count(CROWN), seed=params.seed, where=_at_crown)
    document = with_layer(
        document,
        into="crown",
        patterns=_cut(at_crown, params, 0.018),
        flow=FALL,
        variation=EVEN,
        seed=params.seed + 900,
        lift_m=0.007,
        rise_m=0.05,
    )
    roots = even_roots(mesh, count=params.count(FRINGE), seed=params.seed + 7, where=_above_the_forehead)
    return with_layer(
        document,
        into="fringe",
        patterns=_fringe(roots, params),
        flow=FRINGE_FALL,
        variation=Variation(turn_low=-0.08, turn_high=0.08, tilt_high=0.05, length_low=0.92, length_high=1.06),
        seed=params.seed + 700,
        lift_m=0.007,
        rise_m=0.04,
        bend_m=0.012,
        cling=0.6,
    )


def _cut(roots: EvenRoots, params: StripsParams, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Strips of such lengths that they all end at the line, their tips turned in."""
    return [
        (
            turned_in(
                lock(
                    length_m=length_m * params.length, width_m=width_m * params.widening, root_width=0.5, tip_width=0.6
                ),
                depth_m=0.08 * length_m,
            ),
            band,
        )
        for band, length_m in bands_ending_at(roots, LINE_M)
    ]


def _fringe(roots: EvenRoots, params: StripsParams) -> list[tuple[Strip, EvenRoots]]:
    """Strips that end above the brows, the longer the further back they begin."""
    row = np.floor(roots.points[:, 2] / ROW_M).astype(np.int64)
    return [
        (
            lock(
                length_m=(BROW_WAY_M - number * ROW_M) * params.length,
                width_m=0.017 * params.widening,
                root_width=0.5,
                tip_width=0.6,
            ),
            roots.where(row == number),
        )
        for number in np.unique(row)
    ]


def _at_crown(points: Array) -> Array:
    return (np.hypot(points[:, 0], points[:, 2] - CROWN_Z_M - 0.012) < 0.02) & (points[:, 1] > 0.06)


def _above_the_forehead(points: Array) -> Array:
    """A triangle from the crown to the temples."""
    x, y, z = points.T
    return (np.abs(x) < 0.06) & (np.abs(x) < 0.75 * (z - CROWN_Z_M) + 0.008) & (y > 0.05)


def _beside_the_fringe(points: Array) -> Array:
    return above_the_ears(points) & ~_above_the_forehead(points)
