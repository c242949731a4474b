"""A short crop that grows out of a whorl at the crown."""

from typing import Any

import numpy as np

from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.cap import BACK, with_cap
from tress.methods.strips.even_roots import EvenRoots, even_roots
from tress.methods.strips.flows import added, steady, whorl
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

CROWN = (0.012, 0.085, -0.055)
BEFORE_CROWN, OVER_CROWN = (0.012, 0.098, -0.030), steady((-0.2, -0.8, -0.6))
"""Where the strips begin that lie over the middle of the whorl, and their way."""
TOP_M = 0.085
CAP = 0.36
"""Share of the strips in the cap: they are short, so that there are many."""
FLOW = added(steady((0, -0.6, 0.12)), whorl(CROWN, swirl=0.3, reach_m=0.09))
LAYERS = (
    ("under", 0.30, 0.042, 0.016, 0.0045),
    ("middle", 0.32, 0.046, 0.012, 0.006),
    ("over", 0.27, 0.050, 0.009, 0.0075),
)
"""Group, share of the strips, length, width and lift in metres."""
BELOW_M, SHORTER = (0.05, 0.01, -0.03), (1.0, 0.85, 0.65, 0.45)
"""Heights below which hair is cut shorter, and to which share, from the top to the nape."""
AT_CROWN = 0.06
"""Share of the strips over the middle of the whorl."""
IRREGULAR = Variation(
    turn_low=-0.28, turn_high=0.28, tilt_high=0.1, length_low=0.65, length_high=1.15, width_low=0.6, width_high=1.3
)


def short_crop(document: Document, params: StripsParams) -> Document:
    """Short all round, out of a whorl at the crown."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    document = with_cap(document, params, flow=_close, share=CAP, length_m=0.05, where=_clear_of_the_ears)
    for index, (name, share, length_m, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=_clear_of_the_ears)
        document = with_layer(
            document,
            into=name,
            patterns=_tapered(roots, params, length_m, width_m),
            flow=FLOW,
            variation=IRREGULAR,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            bend_m=0.02,
            cling=0.8,
        )
    at_crown = even_roots(
        mesh,
        count=params.count(AT_CROWN),
        seed=params.seed,
        where=lambda points: np.linalg.norm(points - BEFORE_CROWN, axis=1) < 0.025,
    )
    return with_layer(
        document,
        into="crown",
        patterns=[
            (
                lock(
                    length_m=0.045 * params.length,
                    width_m=0.014 * params.widening,
                    root_width=0.4,
                    tip_width=0.3,
                    rows=6,
                ),
                at_crown,
            )
        ],
        flow=OVER_CROWN,
        variation=IRREGULAR,
        seed=params.seed + 900,
        lift_m=0.004,
        bend_m=0.02,
        cling=0.8,
    )


def _close(points: Array) -> Array:
    """The flow, but on top of the head all back: no gap where the whorl leads to all sides."""
    return np.where(points[:, 1:2] > TOP_M, BACK(points), FLOW(points))


def _clear_of_the_ears(points: Array) -> Array:
    """Not right above them, where short hair would stand off: longer hair from above lies there."""
    return (points[:, 1] > 0.031) | (np.abs(points[:, 2] + 0.003) > 0.034)


def _tapered(roots: EvenRoots, params: StripsParams, length_m: float, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Shorter strips the lower the roots."""
    step = (roots.points[:, 1, None] < BELOW_M).sum(axis=1)
    return [
        (
            lock(
                length_m=share * length_m * params.length,
                width_m=width_m * params.widening,
                root_width=0.5,
                tip_width=0.3,
                rows=6,
            ),
            roots.where(step == number),
        )
        for number, share in enumerate(SHORTER)
        if (step == number).any()
    ]
