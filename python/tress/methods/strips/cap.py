"""The lowest layer of a hairdo: short wide strips close to the scalp, so that no skin shows between those above."""

from tress.edit.comb import Flow
from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.even_roots import Where, above_the_ears, even_roots
from tress.methods.strips.flows import steady
from tress.methods.strips.layers import CAP, with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock
from tress.model.attachment import surface_mesh
from tress.model.document import Document

SHARE, LENGTH_M, WIDTH_M, LIFT_M = 0.28, 0.055, 0.034, 0.0025
BACK = steady((0, -0.4, -1))
MOST = 1.5
"""Where few strips are wide, those of the cap are longer too, up to this factor."""
VARIED = Variation(turn_low=-0.12, turn_high=0.12, length_low=0.85, length_high=1.1)


def with_cap(
    document: Document,
    params: StripsParams,
    *,
    flow: Flow = BACK,
    share: float = SHARE,
    length_m: float = LENGTH_M,
    where: Where = above_the_ears,
) -> Document:
    """The document with a `share` of the strips in the group `cap`: evenly over the scalp, laid along a flow.

    Under a parting or a whorl, where hair falls apart, strips that all go back leave no gap. They keep to the scalp
    where the flow leads away from it, and get the densest cards of an atlas (see `covered`).
    """
    mesh = surface_mesh(document, HEAD, where="A preset")
    roots = even_roots(mesh, count=params.count(share), seed=params.seed + 50, where=where, least_scalp=0.5)
    pattern = lock(
        length_m=length_m * min(params.widening, MOST),
        width_m=WIDTH_M * params.widening,
        root_width=0.35,
        tip_width=0.8,
        rows=7,
    )
    return with_layer(
        document,
        into=CAP,
        patterns=[(pattern, roots)],
        flow=flow,
        variation=VARIED,
        seed=params.seed + 5000,
        lift_m=LIFT_M,
        rise_m=0.015,
        bend_m=0.01,
        cling=1.0,
    )
