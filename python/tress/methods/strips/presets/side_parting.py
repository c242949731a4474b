"""Hair to the jaw, parted on the left and swept over to the right."""

from typing import Any

import numpy as np

from tress.edit.comb import Flow
from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.cap import with_cap
from tress.methods.strips.ending_at import bands_ending_at
from tress.methods.strips.even_roots import EvenRoots, above_the_ears, even_roots
from tress.methods.strips.flows import added, inwards, off_the_face, over_the_ears, parted, steady
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.parting import with_parting
from tress.methods.strips.patterns import lock, turned_in
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

PART_M = 0.032
LINE_M = -0.09
"""Height at which the hair ends, more or less."""
LAYERS = (("under", 0.30, 0.032, 0.005), ("middle", 0.26, 0.024, 0.008), ("over", 0.20, 0.016, 0.010))
"""Group, share of the strips, width and lift in metres."""
IRREGULAR = Variation(turn_low=-0.12, turn_high=0.12, tilt_high=0.03, length_low=0.9, length_high=1.05)


def fall(x_m: float) -> Flow:
    """The way the hair falls from a parting at `x_m`."""
    return added(
        steady((0, -1, -0.05)), parted(x_m, back=0.35, below_m=0.03), over_the_ears(), off_the_face(z_m=0.04), inwards()
    )


def side_parting(document: Document, params: StripsParams) -> Document:
    """Jaw length, parted on the left and swept to the right."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    document = with_cap(document, params)
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=above_the_ears)
        document = with_layer(
            document,
            into=name,
            patterns=_cut(roots, params, width_m),
            flow=fall(PART_M),
            variation=IRREGULAR,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            rise_m=0.04,
        )
    return with_parting(
        document,
        params,
        x_m=PART_M,
        flow=fall,
        patterns=lambda roots: _cut(roots, params, 0.016),
        variation=IRREGULAR,
    )


def _cut(roots: EvenRoots, params: StripsParams, width_m: float) -> list[tuple[Strip, EvenRoots]]:
    """Strips of such lengths that they all end at the jaw, a little turned in."""
    return [
        (
            turned_in(
                lock(
                    length_m=length_m * params.length, width_m=width_m * params.widening, root_width=0.5, tip_width=0.5
                ),
                depth_m=0.05 * length_m,
            ),
            band,
        )
        for band, length_m in bands_ending_at(roots, LINE_M)
    ]
