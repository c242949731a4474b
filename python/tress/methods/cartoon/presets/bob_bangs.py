"""A bob with bangs: chunky clumps cut to one line at the jaw, the tips turned in."""

import numpy as np

from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.clump import ClumpShape
from tress.methods.cartoon.layer import with_cap, with_clumps
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.sheets import bent, cut, length_to, outwards, over_head, sheet
from tress.methods.cartoon.skull import skull_of
from tress.methods.cartoon.splitting import SplitParams
from tress.methods.cartoon.tuft import Tuft
from tress.methods.cartoon.variation import ClumpVariation
from tress.model.document import Document

JAW, BROW = -0.42, 0.06
"""Heights at which the hair ends, as parts of the head's height."""
BODY = ClumpShape(radii=(0.0, 0.6, 0.85, 1.0, 1.0, 1.0, 0.9), tip_shape=((0, 1), (0.5, 0.85), (0.8, 0.5), (1, 0)))


def bob_bangs(document: Document, params: CartoonParams) -> Document:
    """Jaw length all round with bangs, the tips turned in."""
    skull = skull_of(document)
    document = with_cap(document, skull)
    for name, hairs, lift_m, seed in (("under", 17, 0.011, 1), ("over", 14, 0.019, 2)):
        around = np.radians(np.linspace(58, 302, 25))
        long = over_head(skull, azimuth=around, start=0.02, length_m=0.5, lift_m=lift_m, flare=0.1)
        end = length_to(long, height_m=JAW * skull.height_m * params.length)
        curves = cut(long, length_m=end)
        curves = bent(curves, towards=-0.012 * outwards(curves), power=3, begins=0.55)
        document = with_clumps(
            document, name=name, surface=sheet(curves), tuft=_tuft(params, hairs=hairs, width_m=0.021, seed=seed)
        )
    front = np.radians(np.linspace(-62, 62, 15))
    long = over_head(skull, azimuth=front, start=0.03, length_m=0.4, lift_m=0.018, flare=0.1)
    curves = cut(long, length_m=length_to(long, height_m=BROW * skull.height_m - 0.02 * (front / front.max()) ** 2))
    return with_clumps(
        document,
        name="bangs",
        surface=sheet(curves),
        tuft=_tuft(params, hairs=9, width_m=0.02, seed=3, pointiness=0.45),
    )


def _tuft(params: CartoonParams, *, hairs: int, width_m: float, seed: int, pointiness: float = 0.35) -> Tuft:
    return Tuft(
        hairs=KeyHairParams(hairs=params.count(hairs), points=14, jitter=0.3, seed=params.seed + seed),
        clump=ClumpParams(vertical_radius=0.007, horizontal_radius=width_m * params.widening, pointiness=pointiness),
        shape=BODY,
        variation=ClumpVariation(
            radius_low=0.9,
            radius_high=1.15,
            length_low=0.93,
            lift_high=0.003,
            twist_low=-0.2,
            twist_high=0.2,
            seed=params.seed + seed,
        ),
        split=SplitParams(),
    )
