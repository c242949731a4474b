"""Waves to the shoulders, parted a little off the middle."""

from typing import Any

import numpy as np

from tress.edit.comb import Flow
from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.cap import with_cap
from tress.methods.strips.even_roots import EvenRoots, above_the_ears, even_roots
from tress.methods.strips.flows import added, around_the_shoulders, off_the_face, over_the_ears, parted, steady
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.parting import with_parting
from tress.methods.strips.patterns import lock, waved
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

PART_M = -0.012
LAYERS = (("under", 0.30, 0.034, 0.005), ("middle", 0.28, 0.025, 0.008), ("over", 0.22, 0.016, 0.011))
"""Group, share of the strips, width and lift in metres."""
PHASES, WAVE_M, SKULL_M, DRIFT = 10, 0.085, 0.1, 1.0
"""Patterns with the waves shifted; the length of a wave; the skull's radius; turns of phase once around the head."""
IRREGULAR = Variation(turn_low=-0.15, turn_high=0.15, tilt_high=0.03, length_low=0.88, length_high=1.04)


def fall(x_m: float) -> Flow:
    """The way the hair falls from a parting at `x_m`."""
    return added(
        steady((0, -1, -0.04)),
        parted(x_m, back=0.35),
        over_the_ears(),
        off_the_face(z_m=0.03, below_m=0.06),
        around_the_shoulders(),
    )


def wavy_shoulder(document: Document, params: StripsParams) -> Document:
    """Waves to the shoulders, parted off the middle."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    document = with_cap(document, params)
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=above_the_ears)
        document = with_layer(
            document,
            into=name,
            patterns=_waves(roots, params, width_m),
            flow=fall(PART_M),
            variation=IRREGULAR,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            rise_m=0.05,
        )
    return with_parting(
        document,
        params,
        x_m=PART_M,
        flow=fall,
        patterns=lambda roots: _waves(roots, params, 0.018),
        variation=IRREGULAR,
    )


def _waves(roots: EvenRoots, params: StripsParams, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Strips whose waves begin at the top of the head, wherever their roots are, so that the layers wave together."""
    length_m = 0.29 * params.length
    plain = lock(length_m=length_m, width_m=width_m * params.widening, root_width=0.5, tip_width=0.3, rows=16)
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
