"""Long straight hair with a parting in the middle."""

from tress.edit.comb import Flow
from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.cap import with_cap
from tress.methods.strips.even_roots import above_the_ears, even_roots
from tress.methods.strips.flows import added, around_the_shoulders, off_the_face, over_the_ears, parted, steady
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.methods.strips.parting import with_parting
from tress.methods.strips.patterns import lock
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

LAYERS = (("under", 0.30, 0.034, 0.004), ("middle", 0.26, 0.026, 0.006), ("over", 0.20, 0.017, 0.008))
"""Group, share of the strips, width and lift in metres: wide strips close to the head, narrow ones over them."""
IRREGULAR = Variation(turn_low=-0.1, turn_high=0.1, tilt_high=0.03, length_low=0.92, length_high=1.03)


def fall(x_m: float) -> Flow:
    """The way the hair falls from a parting at `x_m`."""
    return added(steady((0, -1, -0.04)), parted(x_m, back=0.3), over_the_ears(), off_the_face(), around_the_shoulders())


def long_straight(document: Document, params: StripsParams) -> Document:
    """Long and straight, parted in the middle."""
    mesh = surface_mesh(document, HEAD, where="A preset")
    document = with_cap(document, params)
    for index, (name, share, width_m, lift_m) in enumerate(LAYERS):
        roots = even_roots(mesh, count=params.count(share), seed=params.seed + index, where=above_the_ears)
        document = with_layer(
            document,
            into=name,
            patterns=[(_lock(params, width_m), roots)],
            flow=fall(0.0),
            variation=IRREGULAR,
            seed=params.seed + 100 * index,
            lift_m=lift_m,
            rise_m=0.05,
        )
    return with_parting(
        document,
        params,
        x_m=0.0,
        flow=fall,
        patterns=lambda roots: [(_lock(params, 0.018), roots)],
        variation=IRREGULAR,
    )


def _lock(params: StripsParams, width_m: float) -> Strip:
    return lock(length_m=0.4 * params.length, width_m=width_m * params.widening, root_width=0.5, tip_width=0.5, rows=10)
