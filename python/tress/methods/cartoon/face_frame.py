"""Bangs and side locks, which most hairdos share."""

import numpy as np

from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.clump import ClumpShape
from tress.methods.cartoon.layer import with_clumps
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.sheets import bent, cut, length_to, over_head, sheet
from tress.methods.cartoon.skull import Skull
from tress.methods.cartoon.splitting import SplitParams
from tress.methods.cartoon.tuft import Tuft
from tress.methods.cartoon.variation import ClumpVariation
from tress.model.document import Document

LEAF = ClumpShape(radii=(0.0, 0.55, 0.8, 0.95, 1.0, 1.0, 1.0), tip_shape=((0, 1), (0.5, 0.8), (0.8, 0.42), (1, 0)))
"""A clump that begins as a point at the whorl and ends as one, wide between."""
BLADE = ClumpShape(radii=(0.0, 0.9, 1.0, 1.0, 0.9, 0.75, 0.6), tip_shape=((0, 1), (0.5, 0.75), (1, 0)))
"""A clump that is wide at once and narrows slowly."""


def with_bangs(
    document: Document,
    skull: Skull,
    params: CartoonParams,
    *,
    hairs: int = 7,
    spread: float = 50.0,
    end: float = 0.08,
    sideways: float = 0.0,
    start: float = 0.03,
    width_m: float = 0.021,
    lift_m: float = 0.017,
) -> Document:
    """Clumps from the whorl over the forehead, `spread` degrees to each side, down to a height (part of the head's
    height above its centre), lower at the sides; `sideways` metres that the tips are swept to the head's left."""
    front = np.radians(np.linspace(-spread, spread, 15))
    long = over_head(skull, azimuth=front, start=start, length_m=0.45, lift_m=lift_m, flare=0.12)
    level = end * skull.height_m - 0.03 * (front / np.radians(60)) ** 2
    curves = cut(long, length_m=length_to(long, height_m=level))
    curves = bent(curves, towards=(sideways, 0, 0), power=4)
    tuft = Tuft(
        hairs=KeyHairParams(hairs=params.count(hairs), points=14, jitter=0.35, seed=params.seed + 70),
        clump=ClumpParams(
            vertical_radius=0.006, horizontal_radius=width_m * params.widening, pointiness=params.pointiness
        ),
        shape=LEAF,
        variation=ClumpVariation(
            radius_low=0.85,
            radius_high=1.2,
            length_low=0.88,
            lift_high=0.005,
            twist_low=-0.3,
            twist_high=0.3,
            seed=params.seed + 71,
        ),
    )
    return with_clumps(document, name="bangs", surface=sheet(curves), tuft=tuft)


def with_side_locks(
    document: Document, skull: Skull, params: CartoonParams, *, end: float = -0.62, width_m: float = 0.015
) -> Document:
    """Two clumps before each ear down to a height, with their tips turned to the chin."""
    for name, side in (("lock_left", 1), ("lock_right", -1)):
        azimuth = side * np.radians(np.linspace(58, 82, 6))[::side]
        long = over_head(skull, azimuth=azimuth, start=0.05, length_m=0.6, lift_m=0.013, flare=0.02)
        curves = cut(long, length_m=length_to(long, height_m=end * skull.height_m * params.length))
        curves = bent(curves, towards=(0.012 * side, 0, 0.012), power=2, begins=0.5)
        tuft = Tuft(
            hairs=KeyHairParams(hairs=2, points=16, jitter=0.2, seed=params.seed + 80 + side),
            clump=ClumpParams(vertical_radius=0.007, horizontal_radius=width_m, pointiness=params.pointiness),
            shape=LEAF,
            variation=ClumpVariation(
                length_low=0.8, lift_high=0.004, twist_low=-0.4, twist_high=0.4, seed=params.seed + 90 + side
            ),
            split=SplitParams(ways=2, apart_root=0.1, apart_tip=0.7, begins=0.55, shorter=0.2),
        )
        document = with_clumps(document, name=name, surface=sheet(curves), tuft=tuft)
    return document
