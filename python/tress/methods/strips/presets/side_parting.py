"""Hair to the jaw, parted on the left and swept over to the right."""

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

PART_M = 0.032
FLOW = added(steady((0, -1, -0.05)), parted(PART_M, back=0.5, below_m=0.03), off_the_face(z_m=0.045))
LINE_M = -0.09
"""Height at which the hair ends, more or less."""
LAYERS = (("under", 0.38, 0.034, 0.004), ("middle", 0.34, 0.026, 0.007), ("over", 0.26, 0.018, 0.009))
"""Group, share of the strips, width and lift in metres."""
PARTING = 0.12
"""Share of the strips that stand on the parting line itself."""
IRREGULAR = Variation(turn_low=-0.12, turn_high=0.12, tilt_high=0.12, length_low=0.9, length_high=1.05)


def side_parting(document: Document, params: StripsParams) -> Document:
    """Jaw length, parted on the left and swept to the right."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=above_the_ears)
        document = with_layer(
            document,
            into=name,
            patterns=_cut(roots, params, width_m),
            flow=FLOW,
            variation=IRREGULAR,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            rise_m=0.04,
        )
    on_line = even_roots(mesh, count=params.count(PARTING), seed=params.seed, where=_on_line)
    return with_layer(
        document,
        into="parting",
        patterns=_cut(on_line, params, 0.016),
        flow=FLOW,
        variation=IRREGULAR,
        seed=params.seed + 900,
        lift_m=0.005,
        rise_m=0.06,
    )


def _cut(roots: EvenRoots, params: StripsParams, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Strips of such lengths that they all end at the jaw, a little turned in."""
    return [
        (
            turned_in(
                lock(length_m=length_m * params.length, width_m=width_m * params.widening, tip_width=0.75),
                depth_m=0.05 * length_m,
            ),
            band,
        )
        for band, length_m in bands_ending_at(roots, LINE_M)
    ]


def _on_line(points: Array) -> Array:
    return (np.abs(points[:, 0] - PART_M) < 0.005) & (points[:, 1] > 0.06)
