"""One layer of a hairdo: patterns attached to roots, combed, and kept off the head."""

from collections.abc import Iterable

import numpy as np

from tress.edit.add import add
from tress.edit.attach import attach
from tress.edit.comb import Flow, comb
from tress.edit.delete import delete
from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.edited import edited
from tress.methods.strips.even_roots import EvenRoots
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.group import Group
from tress.model.strip import Strip

HAIR, CAP, OVER, EDGE, PATTERN = "hair", "cap", "over", "edge", "lock"


def with_layer(
    document: Document,
    *,
    into: str,
    patterns: Iterable[tuple[Strip, EvenRoots]],
    flow: Flow,
    variation: Variation,
    seed: int,
    lift_m: float = 0.004,
    rise_m: float = 0.02,
    bend_m: float = 0.02,
    cling: float = 0.0,
) -> Document:
    """The document with copies of each pattern at its roots, in the new group `into` within `hair`, combed together.

    Every pattern is added, attached with the variation, and deleted; then `comb` lays the whole group along the flow.
    """
    document = placed(document, into=into, patterns=patterns, flow=flow, variation=variation, seed=seed)
    return edited(
        document,
        comb,
        names=[into],
        surface=HEAD,
        flow=flow,
        lift_m=lift_m,
        rise_m=rise_m,
        bend_m=bend_m,
        cling=cling,
    )


def placed(
    document: Document,
    *,
    into: str,
    patterns: Iterable[tuple[Strip, EvenRoots]],
    flow: Flow,
    variation: Variation | None = None,
    seed: int = 0,
) -> Document:
    """The same without combing: the copies stand at their roots, turned along the flow, in the patterns' shapes."""
    groups = {HAIR: Group(), into: Group(parent=HAIR)}
    document = edited(
        document, add, records={name: group for name, group in groups.items() if name not in document.records}
    )
    along = flow(np.asarray(surface_mesh(document, HEAD, where="A layer").positions, np.float64))
    for index, (pattern, roots) in enumerate(patterns):
        document = edited(document, add, records={PATTERN: pattern})
        document = edited(
            document,
            attach,
            names=[PATTERN],
            surface=HEAD,
            triangles=roots.triangles,
            barycentric=roots.barycentric,
            into=into,
            flow=along,
            variation=variation,
            seed=seed + index,
        )
        document = edited(document, delete, names=[PATTERN])
    return document
