"""What the user may correct before a reconstruction is run again."""

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Corrections:
    """The user's corrections, each None where the user gave none; pixels are those of the photo as the stages see it.

    `landmarks`: the face's points instead of the detector's (`tress.head`); `strokes` (H, W) uint8: a layer's label,
    255 where there is no stroke (`tress.image.strokes`); `depth_strokes`: marks of known depth.
    """

    landmarks: Any = None
    strokes: np.ndarray | None = None
    depth_strokes: np.ndarray | None = None
