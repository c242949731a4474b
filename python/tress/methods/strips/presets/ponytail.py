"""Hair swept back from all sides to a tie behind the crown, and a tail that hangs from it."""

from typing import Any

import numpy as np

from tress.edit.variation import HALF_TURN, Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.even_roots import EvenRoots, even_roots
from tress.methods.strips.flows import added, steady, towards
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock, waved
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

TIE = (0.0, 0.062, -0.105)
"""Where the tie holds the hair, behind the back of the head."""
SWEPT = added(towards(TIE), steady((0, 0, -0.15)))
RING_M = 0.02
"""Strips that are so much farther from the tie are as much longer."""
TAIL = steady((0, -1, -0.02))
LAYERS = (("under", 0.46, 0.024, 0.002), ("over", 0.30, 0.015, 0.004))
"""Group, share of the strips, width and lift in metres."""
IN_TAIL = 0.3
"""Share of the strips in the tail."""


def ponytail(document: Document, params: StripsParams) -> Document:
    """Swept back to a tie, with a tail."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, least_scalp=0.5)
        document = with_layer(
            document,
            into=name,
            patterns=_to_tie(roots, width_m * params.widening),
            flow=SWEPT,
            variation=Variation(turn_low=-0.06, turn_high=0.06, length_low=0.97, length_high=1.05),
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            bend_m=0.01,
        )
    tail = lock(length_m=0.3 * params.length, width_m=0.026 * params.widening, root_width=0.5, tip_width=0.5, rows=12)
    return with_layer(
        document,
        into="tail",
        patterns=[
            (
                waved(tail, height_m=0.006, waves=1.2),
                even_roots(mesh, count=params.count(IN_TAIL), seed=params.seed + 5, where=_at_tie),
            )
        ],
        flow=TAIL,
        variation=Variation(
            turn_low=-HALF_TURN, turn_high=HALF_TURN, tilt_low=1.0, tilt_high=1.5, length_low=0.7, length_high=1.05
        ),
        seed=params.seed + 900,
        lift_m=0.012,
        rise_m=0.03,
        bend_m=0.03,
    )


def _to_tie(roots: EvenRoots, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Strips as long as the way over the head to the tie, in rings about it."""
    ring = (np.linalg.norm(roots.points - TIE, axis=1) / RING_M).astype(np.int64)
    return [
        (
            lock(length_m=1.1 * RING_M * (number + 0.6), width_m=width_m, root_width=1.0, tip_width=0.25),
            roots.where(ring == number),
        )
        for number in np.unique(ring)
    ]


def _at_tie(points: Array) -> Array:
    return np.linalg.norm(points - TIE, axis=1) < 0.035
