"""The strips along a parting: each begins a little beyond it, so that those of the other side cover its square end."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from tress.edit.comb import Flow
from tress.edit.variation import Variation
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.even_roots import EvenRoots, even_roots
from tress.methods.strips.layers import with_layer
from tress.methods.strips.params import StripsParams
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

SHARE = 0.13
BEYOND_M = 0.004
HALF_M, FRONT_Z_M, END_Z_M = 0.005, 0.05, -0.045
"""Half the width of the strip of scalp they stand on, and where it ends before and behind."""


def with_parting(
    document: Document,
    params: StripsParams,
    *,
    x_m: float,
    flow: Callable[[float], Flow],
    patterns: Callable[[EvenRoots], Iterable[tuple[Strip, EvenRoots]]],
    variation: Variation,
    lift_m: float = 0.006,
) -> Document:
    """The document with strips along a parting line at `x_m`, in a group for each side.

    `flow(x_m)` is the hairdo's flow with its parting there, `patterns(roots)` says which strips stand at roots.
    """
    mesh = surface_mesh(document, HEAD, where="A preset")

    def on_line(points: Array) -> Array:
        near = np.abs(points[:, 0] - x_m) < HALF_M
        return near & (points[:, 2] < FRONT_Z_M) & (points[:, 2] > END_Z_M) & (points[:, 1] > 0)

    for index, (into, beyond_m) in enumerate((("parting_right", BEYOND_M), ("parting_left", -BEYOND_M))):
        seed = params.seed + 900 + index
        document = with_layer(
            document,
            into=into,
            patterns=patterns(even_roots(mesh, count=params.count(SHARE / 2), seed=seed, where=on_line)),
            flow=flow(x_m + beyond_m),
            variation=variation,
            seed=seed,
            lift_m=lift_m,
            rise_m=0.05,
        )
    return document
