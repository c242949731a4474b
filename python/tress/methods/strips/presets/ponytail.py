"""Hair swept back from all sides to a tie behind the crown, and a tail that hangs from it."""

from typing import Any

import numpy as np

from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.cap import with_cap
from tress.methods.strips.even_roots import EvenRoots, even_roots
from tress.methods.strips.flows import added, steady, towards, up_before_the_ears
from tress.methods.strips.hairline import with_hairline
from tress.methods.strips.layers import placed, with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock
from tress.methods.strips.tail import Tail, band, tail_lock
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

TIE = (0.0, 0.056, -0.106)
"""Where the tie holds the hair, behind the back of the head."""
SWEPT = added(towards(TIE), steady((0, 0.05, -0.1)), up_before_the_ears())
RING_M, SKULL_M = 0.02, 0.095
"""Strips that are so much farther from the tie are as much longer; the radius over which they go there."""
LAYERS = (("under", 0.24, 0.024, 0.004), ("over", 0.22, 0.014, 0.006))
"""Group, share of the strips, width and lift in metres."""
HAIRLINE, IN_TAIL = 0.30, 0.16
"""Shares of the strips at the edge of the hair, and in the tail."""
SHELLS = (0.45, 0.75, 1.0)
"""Radii of the shells in which the strips of the tail lie, as shares of its own."""
DOWN = steady((0, -1, 0))
GOLDEN = 2.399963


def ponytail(document: Document, params: StripsParams) -> Document:
    """Swept back to a tie, with a tail."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    document = with_cap(document, params, flow=SWEPT, where=_before_the_tie)
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index)
        document = with_layer(
            document,
            into=name,
            patterns=_to_tie(roots, width_m * params.widening),
            flow=SWEPT,
            variation=Variation(turn_low=-0.06, turn_high=0.06, length_low=0.97, length_high=1.03),
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            bend_m=0.01,
            cling=0.8,
        )
    document = with_hairline(document, params, flow=SWEPT, share=HAIRLINE)
    return _with_tail(document, params)


def _with_tail(document: Document, params: StripsParams) -> Document:
    """Strips in shells about one axis, all from the tie, and a band around their roots."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    at_tie = even_roots(mesh, count=1, seed=params.seed, where=_at_tie)
    shape = Tail(length_m=0.3 * params.length)
    count = params.count(IN_TAIL)
    locks = [
        tail_lock(
            shape,
            angle_rad=GOLDEN * index,
            shell=SHELLS[index % len(SHELLS)],
            width_m=0.028 * params.widening,
            length=0.8 + 0.2 * (index * 0.618 % 1.0),
        )
        for index in range(count)
    ]
    document = placed(document, into="tail", patterns=[(each, at_tie) for each in locks], flow=DOWN)
    around = [(band(shape, angle_rad=quarter * np.pi / 2), at_tie) for quarter in range(4)]
    return placed(document, into="tie", patterns=around, flow=DOWN)


def _to_tie(roots: EvenRoots, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Strips as long as the way over the head to the tie, in rings about it."""
    ring = (np.linalg.norm(roots.points - TIE, axis=1) / RING_M).astype(np.int64)
    return [
        (
            lock(length_m=_way(RING_M * (number + 0.5)), width_m=width_m, root_width=0.25, tip_width=0.3),
            roots.where(ring == number),
        )
        for number in np.unique(ring)
    ]


def _way(straight_m: float) -> float:
    """The way over the skull between places so far apart."""
    return 2 * SKULL_M * float(np.arcsin(min(straight_m / (2 * SKULL_M), 1.0)))


def _at_tie(points: Array) -> Array:
    return np.linalg.norm(points - TIE, axis=1) < 0.025


def _before_the_tie(points: Array) -> Array:
    """So far from the tie that strips of the cap do not reach beyond it."""
    return np.linalg.norm(points - TIE, axis=1) > 0.07
