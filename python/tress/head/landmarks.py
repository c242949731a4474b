"""The 468 points of a face: where they are, and which of them carry a name."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError

COUNT = 468
RIGHT_EYE_CORNERS = (33, 133)
"""Outer and inner corner of the person's right eye, the left one in the picture."""
LEFT_EYE_CORNERS = (263, 362)
NOSE_TIP = 1
MOUTH_CORNERS = (61, 291)
"""The person's right and left corner of the mouth."""
CHIN = 152
FOREHEAD = 10
FACE_OVAL = (
    *(10, 338, 297, 332, 284, 251, 389, 356, 454, 323, 361, 288, 397, 365, 379, 378, 400, 377),
    *(152, 148, 176, 149, 150, 136, 172, 58, 132, 93, 234, 127, 162, 21, 54, 103, 67, 109),
)
"""The face's outline from the forehead's middle down the person's left side and up the right."""


@dataclass(frozen=True)
class FaceLandmarks:
    """The 468 points of the MediaPipe face mesh on one face.

    `points` (468, 3) float32: x, y in px of the picture (x right, y down, first pixel's centre at 0.5), z in px TOWARDS
    the camera, about zero at the face's outline (a guess, to be trusted little). `score` in [0, 1] is the
    network's belief that there is a face. `weights` (468,) float32 in [0, 1]: 0 where a point was not given (by hand).
    Raises `InputError` on a wrong shape or on numbers that are not finite.
    """

    points: NDArray[np.float32]
    score: float
    weights: NDArray[np.float32]

    def __post_init__(self) -> None:
        if self.points.shape != (COUNT, 3) or self.weights.shape != (COUNT,):
            raise InputError(f"Landmarks have the shape {self.points.shape}; ({COUNT}, 3) was expected.")
        if not (np.isfinite(self.points).all() and np.isfinite(self.weights).all()):
            raise InputError("Landmarks hold numbers that are not finite.")
        self.points.setflags(write=False)
        self.weights.setflags(write=False)

    @property
    def box(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 of the given points, px."""
        given = self.points[self.weights > 0, :2]
        (x0, y0), (x1, y1) = given.min(axis=0), given.max(axis=0)
        return float(x0), float(y0), float(x1), float(y1)

    @property
    def eyes(self) -> NDArray[np.float64]:
        """The person's right and left eye (2, 2) x, y px: half-way between the corners."""
        corners = np.array([RIGHT_EYE_CORNERS, LEFT_EYE_CORNERS])
        return self.points[corners, :2].astype(np.float64).mean(axis=1)

    @property
    def inter_ocular_px(self) -> float:
        """The distance between the eyes in the picture, px."""
        right, left = self.eyes
        return float(np.linalg.norm(left - right))


def landmarks_of(points: NDArray[np.floating], *, score: float = 1.0) -> FaceLandmarks:
    """`FaceLandmarks` from points (468, 3) or (468, 2) px, all fully weighted."""
    array = np.asarray(points, np.float32)
    if array.ndim == 2 and array.shape[1] == 2:
        array = np.column_stack([array, np.zeros(len(array), np.float32)])
    return FaceLandmarks(array.copy(), score, np.ones(len(array), np.float32))
