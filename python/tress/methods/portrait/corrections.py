"""What the user may correct before a reconstruction is run again."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.head.hand_points import HandPoints


@dataclass(frozen=True)
class Corrections:
    """The user's corrections, each None where the user gave none; pixels are those of the photo as the stages see it.

    `face`: which of several faces, counted from the left from 0. `landmarks`: points of the face given by hand.
    `strokes` (H, W) uint8: a layer's label, 255 where there is no stroke (`tress.image.strokes`). `depth_strokes`
    (H, W) float32: depth towards the camera in metres, in the view frame; NaN where there is no stroke.
    """

    face: int | None = None
    landmarks: HandPoints | None = None
    strokes: NDArray[np.uint8] | None = None
    depth_strokes: NDArray[np.float32] | None = None
