"""A high ponytail with swept bangs and locks before the ears."""

import numpy as np

from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.face_frame import with_bangs, with_side_locks
from tress.methods.cartoon.layer import with_cap
from tress.methods.cartoon.sheets import swept_to
from tress.methods.cartoon.skull import skull_of
from tress.methods.cartoon.tails import with_swept, with_tail
from tress.model.document import Document

TIE = (0.0, 0.62, -0.78)
"""Direction of the tie from the head's centre."""


def ponytail(document: Document, params: CartoonParams) -> Document:
    """Swept back to a high tie, with a full tail, bangs, and locks before the ears."""
    skull = skull_of(document)
    document = with_cap(document, skull)
    around = np.radians(np.linspace(-180, 170, 36))
    curves = swept_to(skull, tie=TIE, azimuth=around, lift_m=0.006)
    document = with_swept(document, params, curves=curves, hairs=22, width_m=0.02, seed=1)
    tie = skull.points(0.0, 0.0, pole=TIE)
    down = skull.height_m * params.length
    control = tie + np.array(
        [[0, -0.004, 0.004], [0, 0.06, -0.06], [0, 0.05, -0.17], [0, -0.3, -0.12], [0, -1.0, -0.03]]
    )
    control[3:, 1] = tie[1] - np.array([0.55, 1.6]) * down
    document = with_tail(document, params, name="tail", control=control, radius_m=0.042, seed=5)
    document = with_bangs(document, skull, params, sideways=0.02)
    return with_side_locks(document, skull, params)
