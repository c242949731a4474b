"""Waves to the shoulders, parted a little off the middle."""

from typing import Any

import numpy as np

from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.even_roots import EvenRoots, even_roots
from tress.methods.strips.flows import added, off_the_face, parted, steady
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock, waved
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

PART_M = -0.012
FLOW = added(steady((0, -1, -0.04)), parted(PART_M, back=0.35), off_the_face())
LAYERS = (("under", 0.34, 0.044, 0.004), ("middle", 0.34, 0.034, 0.008), ("over", 0.24, 0.024, 0.012))
"""Group, share of the strips, width and lift in metres."""
PARTING = 0.08
"""Share of the strips that stand on the parting line itself."""
PHASES_RAD = (0.0, 1.6, 3.1, 4.7)
"""Patterns with the waves shifted, so that neighbours do not run in step."""
IRREGULAR = Variation(turn_low=-0.15, turn_high=0.15, tilt_high=0.15, length_low=0.8, length_high=1.1)


def wavy_shoulder(document: Document, params: StripsParams) -> Document:
    """Waves to the shoulders, parted off the middle."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index)
        document = with_layer(
            document,
            into=name,
            patterns=_waves(roots, params, width_m),
            flow=FLOW,
            variation=IRREGULAR,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            rise_m=0.05,
        )
    on_line = even_roots(mesh, count=params.count(PARTING), seed=params.seed, where=_on_line)
    return with_layer(
        document,
        into="parting",
        patterns=_waves(on_line, params, 0.022),
        flow=FLOW,
        variation=IRREGULAR,
        seed=params.seed + 900,
        lift_m=0.010,
        rise_m=0.05,
    )


def _waves(roots: EvenRoots, params: StripsParams, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """A quarter of the roots for each phase."""
    plain = lock(length_m=0.29 * params.length, width_m=width_m * params.widening, tip_width=0.35, rows=16)
    turn = np.arange(len(roots.triangles)) % len(PHASES_RAD)
    return [
        (waved(plain, height_m=0.008, waves=3.2 * params.length, phase_rad=phase_rad), roots.where(turn == number))
        for number, phase_rad in enumerate(PHASES_RAD)
    ]


def _on_line(points: Array) -> Array:
    return (np.abs(points[:, 0] - PART_M) < 0.005) & (points[:, 1] > 0.06)
