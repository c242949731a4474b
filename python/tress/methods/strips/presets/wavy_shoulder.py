"""Waves to the shoulders, parted a little off the middle."""

from typing import Any

import numpy as np

from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.even_roots import EvenRoots, above_the_ears, even_roots
from tress.methods.strips.flows import added, around_the_shoulders, off_the_face, parted, steady
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock, waved
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

PART_M = -0.012
FLOW = added(steady((0, -1, -0.04)), parted(PART_M, back=0.35), off_the_face(), around_the_shoulders())
LAYERS = (("under", 0.38, 0.040, 0.004), ("middle", 0.36, 0.030, 0.007), ("over", 0.26, 0.020, 0.010))
"""Group, share of the strips, width and lift in metres."""
PARTING = 0.12
"""Share of the strips that stand on the parting line itself."""
PHASES, WAVE_M, SKULL_M, DRIFT = 10, 0.085, 0.1, 1.0
"""Patterns with the waves shifted; the length of a wave; the skull's radius; turns of phase once around the head."""
IRREGULAR = Variation(turn_low=-0.15, turn_high=0.15, tilt_high=0.15, length_low=0.88, length_high=1.04)


def wavy_shoulder(document: Document, params: StripsParams) -> Document:
    """Waves to the shoulders, parted off the middle."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=above_the_ears)
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
        patterns=_waves(on_line, params, 0.018),
        flow=FLOW,
        variation=IRREGULAR,
        seed=params.seed + 900,
        lift_m=0.006,
        rise_m=0.06,
    )


def _waves(roots: EvenRoots, params: StripsParams, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Strips whose waves begin at the top of the head, wherever their roots are, so that the layers wave together."""
    length_m = 0.29 * params.length
    plain = lock(length_m=length_m, width_m=width_m * params.widening, tip_width=0.75, rows=16)
    number = np.floor(_turns(roots.points) * PHASES).astype(np.int64) % PHASES
    return [
        (
            waved(plain, height_m=0.007, waves=length_m / WAVE_M, phase_rad=2 * np.pi * phase / PHASES),
            roots.where(number == phase),
        )
        for phase in np.unique(number)
    ]


def _turns(points: Array) -> Array:
    """(N,) waves on the way from the top of the head, and a drift around it."""
    x, y, z = points.T
    way = SKULL_M * np.arccos(y / np.linalg.norm(points, axis=1))
    return way / WAVE_M + DRIFT * np.arctan2(x, -z) / (2 * np.pi)


def _on_line(points: Array) -> Array:
    return (np.abs(points[:, 0] - PART_M) < 0.005) & (points[:, 1] > 0.06)
