"""The edge of the hair: thin pointed strips, staggered, so that it does not begin at one line."""

from tress.edit.comb import Flow
from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.even_roots import Where, even_roots
from tress.methods.strips.layers import EDGE, with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.patterns import lock
from tress.model.attachment import surface_mesh
from tress.model.document import Document

RIM = (0.22, 0.75)
"""Values of the mask `scalp` at the edge."""
LENGTH_M, WIDTH_M = 0.055, 0.010
VARIED = Variation(
    location_m=0.003,
    turn_low=-0.2,
    turn_high=0.2,
    length_low=0.5,
    length_high=1.3,
    width_low=0.5,
    width_high=1.2,
)


def with_hairline(
    document: Document,
    params: StripsParams,
    *,
    flow: Flow,
    share: float,
    length_m: float = LENGTH_M,
    cling: float = 1.0,
    where: Where | None = None,
) -> Document:
    """The document with a `share` of the strips in the group `edge`, around the rim of the scalp, laid along a flow."""
    low, high = RIM
    mesh = surface_mesh(document, HEAD, where="A preset")
    roots = even_roots(
        mesh, count=params.count(share), seed=params.seed + 60, where=where, least_scalp=low, most_scalp=high
    )
    pattern = lock(
        length_m=length_m, width_m=WIDTH_M * min(params.widening, 1.5), root_width=0.15, tip_width=0.4, rows=7
    )
    return with_layer(
        document,
        into=EDGE,
        patterns=[(pattern, roots)],
        flow=flow,
        variation=VARIED,
        seed=params.seed + 6000,
        lift_m=0.005,
        rise_m=0.03,
        bend_m=0.015,
        cling=cling,
    )
