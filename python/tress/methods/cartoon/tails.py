"""Hair swept to a tie, and a tail that hangs from it."""

from typing import Any

import numpy as np

from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.clump import ClumpShape
from tress.methods.cartoon.layer import with_clumps
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.sheets import FINE, bezier, by_length, sheet, tube
from tress.methods.cartoon.tuft import Tuft
from tress.methods.cartoon.variation import ClumpVariation
from tress.model.document import Document

Array = np.ndarray[Any, Any]

LYING = "swept"
"""How the groups begin whose clumps lie on the head from end to end."""
SWEPT = ClumpShape(radii=(0.35, 0.85, 1.0, 0.95, 0.85, 0.7, 0.5, 0.3), tip_shape=((0, 1), (1, 0.4)))
FULL = ClumpShape(radii=(0.0, 0.75, 1.0, 1.0, 0.95, 0.85, 0.7), tip_shape=((0, 1), (0.5, 0.7), (0.85, 0.25), (1, 0)))


def with_swept(
    document: Document, params: CartoonParams, *, name: str = "", curves: Array, hairs: int, width_m: float, seed: int
) -> Document:
    """Flat clumps side by side along curves (V, K, 3) from a hairline to a tie, narrower towards it."""
    tuft = Tuft(
        hairs=KeyHairParams(hairs=params.count(hairs), points=14, jitter=0.25, seed=params.seed + seed),
        clump=ClumpParams(vertical_radius=0.0055, horizontal_radius=width_m * params.widening, pointiness=0.2),
        shape=SWEPT,
        variation=ClumpVariation(radius_low=0.95, radius_high=1.15, lift_high=0.002, seed=params.seed + seed),
    )
    return with_clumps(document, name=LYING + name, surface=sheet(curves), tuft=tuft)


def with_tail(
    document: Document,
    params: CartoonParams,
    *,
    name: str,
    control: Any,
    radius_m: float,
    hairs: int = 8,
    seed: int = 0,
) -> Document:
    """A tail about the Bézier curve of `control` points (Q, 3), narrow at the tie, full below, pointed at the end: a
    ring of clumps, and some within that end between them."""
    axis = by_length(bezier(np.asarray(control, float)[None]), count=FINE)[0]
    part = np.linspace(0, 1, FINE)
    swell = np.interp(part, [0, 0.08, 0.3, 0.6, 0.85, 1], [0.3, 0.55, 1.0, 0.85, 0.5, 0.25])
    for layer, share, thick in (("", 1.0, 1.0), ("_within", 0.45, 1.2)):
        count = params.count(hairs) if not layer else max(params.count(hairs) // 2, 2)
        tuft = Tuft(
            hairs=KeyHairParams(hairs=count, points=18),
            clump=ClumpParams(
                vertical_radius=0.42 * thick * radius_m,
                horizontal_radius=0.62 * thick * radius_m * 8 / params.count(hairs),
                pointiness=params.pointiness,
            ),
            shape=FULL,
            variation=ClumpVariation(
                radius_low=0.9,
                radius_high=1.2,
                length_low=0.78,
                twist_low=-0.5,
                twist_high=0.5,
                seed=params.seed + seed + len(layer),
            ),
        )
        curves = tube(axis, radius_m=share * radius_m * swell, hairs=count)
        document = with_clumps(document, name=f"{name}{layer}", surface=sheet(curves, rows=12), tuft=tuft)
    return document
