"""A short crop that grows out of a whorl at the crown."""

import numpy as np

from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.even_roots import even_roots
from tress.methods.strips.flows import added, steady, whorl
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock
from tress.model.attachment import surface_mesh
from tress.model.document import Document

CROWN = (0.012, 0.085, -0.055)
FLOW = added(steady((0, -0.6, 0.12)), whorl(CROWN, swirl=0.3, reach_m=0.09))
LAYERS = (("under", 0.55, 0.032, 0.028, 0.002), ("over", 0.70, 0.042, 0.018, 0.005))
"""Group, share of the strips, length, width and lift in metres."""
AT_CROWN = 0.07
"""Share of the strips that close the middle of the whorl."""
IRREGULAR = Variation(turn_low=-0.3, turn_high=0.3, tilt_high=0.35, length_low=0.7, length_high=1.2)


def short_crop(document: Document, params: StripsParams) -> Document:
    """Short all round, out of a whorl at the crown."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    for index, (name, share, length_m, width_m, lift_m) in enumerate(LAYERS):
        pattern = lock(length_m=length_m * params.length, width_m=width_m * params.widening, tip_width=0.2, rows=5)
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, least_scalp=0.3)
        document = with_layer(
            document,
            into=name,
            patterns=[(pattern, roots)],
            flow=FLOW,
            variation=IRREGULAR,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            bend_m=0.015,
        )
    at_crown = even_roots(
        mesh,
        count=params.count(AT_CROWN),
        seed=params.seed,
        where=lambda points: np.linalg.norm(points - CROWN, axis=1) < 0.022,
    )
    return with_layer(
        document,
        into="crown",
        patterns=[
            (lock(length_m=0.04 * params.length, width_m=0.02 * params.widening, tip_width=0.2, rows=5), at_crown)
        ],
        flow=FLOW,
        variation=IRREGULAR,
        seed=params.seed + 900,
        lift_m=0.004,
        bend_m=0.015,
    )
