"""A detected face: its box, six points and how sure the detector is."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class FaceBox:
    """One detected face, in pixels of the picture (x right, y down, first pixel's centre at 0.5).

    `box` is x0, y0, x1, y1; `keypoints` (6, 2) float64 are the person's right eye, left eye, nose tip, mouth, right ear
    and left ear; `score` lies in [0, 1].
    """

    box: tuple[float, float, float, float]
    keypoints: NDArray[np.float64]
    score: float

    @property
    def size(self) -> float:
        """The longer side of the box, px."""
        x0, y0, x1, y1 = self.box
        return max(x1 - x0, y1 - y0)

    @property
    def center(self) -> NDArray[np.float64]:
        """The box's centre (2,), px."""
        x0, y0, x1, y1 = self.box
        return np.array([(x0 + x1) / 2, (y0 + y1) / 2])
