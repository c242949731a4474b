"""Long straight hair with a parting in the middle."""

import numpy as np

from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.even_roots import above_the_ears, even_roots
from tress.methods.strips.flows import added, around_the_shoulders, off_the_face, parted, steady
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock
from tress.model.attachment import surface_mesh
from tress.model.document import Document

FLOW = added(steady((0, -1, -0.04)), parted(0.0, back=0.3), off_the_face(), around_the_shoulders())
LAYERS = (("under", 0.40, 0.036, 0.003), ("middle", 0.34, 0.028, 0.005), ("over", 0.26, 0.018, 0.007))
"""Group, share of the strips, width and lift in metres: wide strips close to the head, narrow ones over them."""
PARTING = 0.12
"""Share of the strips that stand on the parting line itself."""
IRREGULAR = Variation(turn_low=-0.1, turn_high=0.1, tilt_high=0.1, length_low=0.92, length_high=1.03)


def long_straight(document: Document, params: StripsParams) -> Document:
    """Long and straight, parted in the middle."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        pattern = lock(length_m=0.4 * params.length, width_m=width_m * params.widening, tip_width=0.7, rows=10)
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=above_the_ears)
        document = with_layer(
            document,
            into=name,
            patterns=[(pattern, roots)],
            flow=FLOW,
            variation=IRREGULAR,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            rise_m=0.05,
        )
    on_line = even_roots(
        mesh, count=params.count(PARTING), seed=params.seed, where=lambda points: np.abs(points[:, 0]) < 0.005
    )
    pattern = lock(length_m=0.4 * params.length, width_m=0.018 * params.widening, tip_width=0.7, rows=10)
    return with_layer(
        document,
        into="parting",
        patterns=[(pattern, on_line)],
        flow=FLOW,
        variation=IRREGULAR,
        seed=params.seed + 900,
        lift_m=0.006,
        rise_m=0.06,
    )
