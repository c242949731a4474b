"""Two tails high at the sides, parted behind."""

import numpy as np

from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.face_frame import with_bangs, with_side_locks
from tress.methods.cartoon.layer import with_cap
from tress.methods.cartoon.sheets import mirrored, swept_to
from tress.methods.cartoon.skull import Skull, directions, skull_of
from tress.methods.cartoon.tails import with_swept, with_tail
from tress.model.document import Document

TIE = (0.72, 0.52, -0.42)
"""Direction of the left tie from the head's centre; the right one mirrors it."""


def twin_tails(document: Document, params: CartoonParams) -> Document:
    """Two long tails from ties at the sides, with bangs and locks before the ears."""
    skull = skull_of(document)
    document = with_cap(document, skull)
    around = np.radians(np.linspace(-180, 170, 36))
    left = swept_to(skull, tie=TIE, azimuth=around, lift_m=0.006, edge=_to_parting(skull, around))
    tie = skull.points(0.0, 0.0, pole=TIE)
    drop = skull.height_m * params.length
    control = tie + np.array(
        [[-0.004, -0.003, 0], [0.08, 0.05, -0.01], [0.13, 0, -0.02], [0.07, 0, 0], [0.09, 0, 0.02]]
    )
    control[2:, 1] = tie[1] - np.array([0.05, 1.0, 1.9]) * drop
    for name, side, curves in (("left", 1, left), ("right", -1, mirrored(left))):
        seed = 10 if side > 0 else 20
        document = with_swept(document, params, name=f"_{name}", curves=curves, hairs=16, width_m=0.018, seed=seed)
        document = with_tail(
            document, params, name=f"tail_{name}", control=control * [side, 1, 1], radius_m=0.034, hairs=7, seed=seed
        )
    document = with_bangs(document, skull, params, hairs=8)
    return with_side_locks(document, skull, params)


def _to_parting(skull: Skull, azimuth: np.ndarray) -> np.ndarray:
    """(V,) polar angles from the tie to the hairline, or to the middle of the head where that comes first."""
    polar = np.linspace(0.0, np.pi, 240)
    across = directions(azimuth[:, None], polar, pole=TIE)[..., 0] < 0.05
    middle = np.where(across.any(axis=1), polar[np.argmax(across, axis=1)], np.pi)
    return np.minimum(middle, skull.hairline(azimuth, pole=TIE))
