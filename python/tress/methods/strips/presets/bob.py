"""A bob: cut to one line below the chin, the tips turned in, with a fringe."""

from typing import Any

import numpy as np

from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.ending_at import bands_ending_at
from tress.methods.strips.even_roots import EvenRoots, above_the_ears, even_roots
from tress.methods.strips.flows import added, off_the_face, parted, steady
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock, turned_in
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

FALL = added(steady((0, -1, 0)), parted(0.0, back=0.3), off_the_face(z_m=0.05))
FRINGE_FALL = steady((0, -1, 0.35))
LINE_M = -0.105
"""Height of the cut."""
LAYERS = (("under", 0.36, 0.036, 0.003), ("middle", 0.32, 0.028, 0.005), ("over", 0.20, 0.018, 0.007))
"""Group, share of the strips, width and lift in metres."""
FRINGE, PARTING = 0.16, 0.09
"""Shares of the strips over the forehead, and on the line along which the hair falls apart behind it."""
EVEN = Variation(turn_low=-0.1, turn_high=0.1, tilt_high=0.1, length_low=0.97, length_high=1.03)


def bob(document: Document, params: StripsParams) -> Document:
    """Chin length with a fringe, the tips turned in."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=above_the_ears)
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
    on_line = even_roots(mesh, count=params.count(PARTING), seed=params.seed, where=_on_line)
    document = with_layer(
        document,
        into="parting",
        patterns=_cut(on_line, params, 0.018),
        flow=FALL,
        variation=EVEN,
        seed=params.seed + 900,
        lift_m=0.006,
        rise_m=0.06,
    )
    fringe = lock(length_m=0.095 * params.length, width_m=0.02 * params.widening, tip_width=0.9)
    return with_layer(
        document,
        into="fringe",
        patterns=[
            (fringe, even_roots(mesh, count=params.count(FRINGE), seed=params.seed + 7, where=_above_the_forehead))
        ],
        flow=FRINGE_FALL,
        variation=Variation(turn_low=-0.1, turn_high=0.1, tilt_high=0.1, length_low=0.85, length_high=1.1),
        seed=params.seed + 700,
        lift_m=0.007,
        rise_m=0.03,
    )


def _cut(roots: EvenRoots, params: StripsParams, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Strips of such lengths that they all end at the line, their tips turned in."""
    return [
        (
            turned_in(
                lock(length_m=length_m * params.length, width_m=width_m * params.widening, tip_width=0.85),
                depth_m=0.08 * length_m,
            ),
            band,
        )
        for band, length_m in bands_ending_at(roots, LINE_M)
    ]


def _on_line(points: Array) -> Array:
    return (np.abs(points[:, 0]) < 0.005) & (points[:, 1] > 0.06) & (points[:, 2] < 0.03)


def _above_the_forehead(points: Array) -> Array:
    return (points[:, 2] > 0.022) & (np.abs(points[:, 0]) < 0.048)
