"""Long hair that the wind blows to one side."""

import numpy as np

from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.clump import ClumpShape
from tress.methods.cartoon.face_frame import with_bangs
from tress.methods.cartoon.flutter import FlutterParams, flutter
from tress.methods.cartoon.layer import with_cap, with_clumps
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.sheets import bent, over_head, sheet
from tress.methods.cartoon.skull import skull_of
from tress.methods.cartoon.splitting import SplitParams
from tress.methods.cartoon.tuft import Tuft
from tress.methods.cartoon.variation import ClumpVariation
from tress.model.document import Document

LEE, WINDWARD = np.array([0.22, 0.12, -0.10]), np.array([0.10, 0.06, -0.22])
"""Where the wind has the tips on either side, metres from where they would hang: past the neck, not through it."""
LONG = ClumpShape(radii=(0.0, 0.6, 0.9, 1.0, 1.0, 1.0, 0.9, 0.8), tip_shape=((0, 1), (0.5, 0.7), (0.85, 0.3), (1, 0)))
LAYERS = (("under", 13, 0.012, 0.9), ("over", 11, 0.02, 1.0))


def long_wind(document: Document, params: CartoonParams) -> Document:
    """Long hair in the wind, in motion."""
    skull = skull_of(document)
    document = with_cap(document, skull)
    for index, (name, hairs, lift_m, share) in enumerate(LAYERS):
        around = np.radians(np.linspace(62, 298, 25))
        long = 2.1 * share * skull.height_m * params.length
        curves = over_head(skull, azimuth=around, start=0.02, length_m=long, lift_m=lift_m, flare=0.1)
        lee = 0.5 + 0.5 * np.sin(around)[:, None]
        blown = params.length * (lee * LEE + (1 - lee) * WINDWARD)
        curves = bent(curves, towards=blown, power=1.8, begins=0.35)
        tuft = Tuft(
            hairs=KeyHairParams(hairs=params.count(hairs), points=18, jitter=0.4, seed=params.seed + index),
            clump=ClumpParams(
                vertical_radius=0.009, horizontal_radius=0.024 * params.widening, pointiness=params.pointiness
            ),
            shape=LONG,
            variation=ClumpVariation(
                radius_low=0.85,
                radius_high=1.2,
                length_low=0.75,
                twist_low=-0.8,
                twist_high=0.8,
                lift_high=0.004,
                seed=params.seed + index,
            ),
            split=SplitParams(ways=2, apart_root=0.15, apart_tip=0.9, begins=0.5, slimmer=0.8),
        )
        waves = flutter(f"{name}_surface", params=FlutterParams())
        document = with_clumps(document, name=name, surface=sheet(curves, rows=12), tuft=tuft, motion=waves)
    return with_bangs(document, skull, params, sideways=0.03)
