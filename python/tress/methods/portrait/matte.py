"""The stage `matte`: alpha and true colour of the hair."""

import numpy as np
from numpy.typing import NDArray

from tress.base.report import Report
from tress.head.landmarks import FaceLandmarks
from tress.image.labels import HAIR
from tress.image.layers import Layers
from tress.image.matte import Matte, MatteParams, matte_of_mask
from tress.image.strokes import NO_STROKE
from tress.methods.portrait.priors import HEAD_HEIGHT, face_frame


def matte_stage(
    image: NDArray[np.uint8],
    *,
    layers: Layers,
    landmarks: FaceLandmarks,
    strokes: NDArray[np.uint8] | None = None,
    params: MatteParams = MatteParams(),
    report: Report,
) -> Matte:
    """The matte of the hair in the photograph `image` (H, W, 3) uint8 sRGB; strokes of other layers stay free of hair.

    Reports the unknown pixels and the solver's iterations; warns where it did not converge.
    """
    other = None if strokes is None else (strokes != NO_STROKE) & (strokes != HAIR)
    head_height_px = HEAD_HEIGHT * face_frame(landmarks).height_px
    matte = matte_of_mask(
        image, mask=layers.hair_mask, head_height_px=head_height_px, known_background=other, params=params
    )
    report.number("unknown_pixels", int((matte.trimap == 128).sum()))
    report.number("iterations", matte.iterations)
    if not matte.converged:
        report.warn("the matte did not converge; its soft edges may be off.")
    return matte
