"""From a picture to the landmarks of one face, with a documented choice or a clear error wherever that is not plain."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError, NoFaceError
from tress.base.report import Report
from tress.head.detector import OpenCvFaceDetector, find_faces
from tress.head.face import FaceBox
from tress.head.face_mesh import OpenCvLandmarkModel, crop_of_landmarks, locate_landmarks
from tress.head.hand_points import NAMED, HandPoints, landmarks_from_named
from tress.head.landmarks import FaceLandmarks
from tress.head.network import FaceDetector, LandmarkModel

SURE = 0.5
"""Least score of the landmark network for a face."""
SMALLEST_EYE_DISTANCE_PX = 16.0
SMALL_EYE_DISTANCE_PX = 40.0
CUT_OFF = 0.35
"""Share of the landmarks outside the picture from which a face cannot be used."""
AGREEMENT = 0.25
"""How far, in eye distances, the network may differ from points given by hand and still be believed."""


@dataclass(frozen=True)
class FaceReader:
    """The two networks that find a face; the built ones unless others are given."""

    detector: FaceDetector | None = None
    model: LandmarkModel | None = None

    @cached_property
    def faces(self) -> FaceDetector:
        """The detector in use."""
        return self.detector or OpenCvFaceDetector()

    @cached_property
    def points(self) -> LandmarkModel:
        """The landmark network in use."""
        return self.model or OpenCvLandmarkModel()


def read_face(
    image: NDArray[np.uint8],
    *,
    face: int | None = None,
    landmarks: HandPoints | None = None,
    reader: FaceReader | None = None,
    report: Report | None = None,
) -> FaceLandmarks:
    """The landmarks of one face of `image` (H, W, 3) uint8 sRGB.

    Several faces are ranked by size and closeness to the picture's middle; the first is taken and a warning reported,
    `face` names another, counted from the left from 0. `landmarks` given by hand replace detection: all 468 are used
    as they are; a few named points show the network where to look, and stand in for it with an average face where it
    sees none.

    Raises `NoFaceError` where there is no face, or it is too small or too much cut off; `InputError` where `face`
    names none.
    """
    reader, report = reader or FaceReader(), report or Report()
    if isinstance(landmarks, FaceLandmarks):
        found = landmarks
    elif landmarks is not None:
        found = _near_hand_points(image, landmarks, reader.points, report)
    else:
        found = _chosen(image, face, reader, report)
    _check_size(found, report)
    _check_frame(found, image.shape[:2], report)
    return found


def by_prominence(faces: list[FaceBox], *, height: int, width: int) -> list[FaceBox]:
    """Faces, the most prominent first: size, less up to two thirds for being at the picture's edge."""
    middle, reach = np.array([width, height]) / 2, np.hypot(width, height) / 2
    return sorted(faces, key=lambda face: -face.size * (1 - 0.67 * float(np.linalg.norm(face.center - middle)) / reach))


def _chosen(image: NDArray[np.uint8], face: int | None, reader: FaceReader, report: Report) -> FaceLandmarks:
    height, width = image.shape[:2]
    read: list[tuple[FaceBox, FaceLandmarks]] = []

    def confirmed(box: FaceBox) -> bool:
        points = locate_landmarks(image, box, model=reader.points)
        new = points.score >= SURE and not any(_same(points, other) for _, other in read)
        if new:
            read.append((box, points))
        return new

    find_faces(image, detector=reader.faces, count=1 if face is None else face + 1, confirmed=confirmed)
    if not read:
        raise NoFaceError(
            "No face was found; use a picture with a visible face, or give the eyes by hand with --landmarks."
        )
    report.number("faces", len(read))
    from_left = sorted(read, key=lambda pair: float(pair[0].center[0]))
    if face is not None:
        if not 0 <= face < len(read):
            raise InputError(f"Face {face} was asked for; {len(read)} found, counted from the left from 0.")
        return from_left[face][1]
    first = by_prominence([box for box, _ in read], height=height, width=width)[0]
    number = next(k for k, (box, _) in enumerate(from_left) if box is first)
    if len(read) > 1:
        report.warn(f"{len(read)} faces were found; number {number} from the left, the most prominent, was taken.")
    return from_left[number][1]


def _same(one: FaceLandmarks, other: FaceLandmarks) -> bool:
    apart = np.linalg.norm(one.points[:, :2].mean(axis=0) - other.points[:, :2].mean(axis=0))
    return bool(apart < 0.5 * (other.box[3] - other.box[1]))


def _near_hand_points(
    image: NDArray[np.uint8], points: Mapping[str, tuple[float, float]], model: LandmarkModel, report: Report
) -> FaceLandmarks:
    guess = landmarks_from_named(points)
    found = model.landmarks(image, crop_of_landmarks(guess))
    found = model.landmarks(image, crop_of_landmarks(found)) if found.score >= SURE else found
    off = [np.linalg.norm(found.points[list(NAMED[name]), :2].mean(axis=0) - point) for name, point in points.items()]
    if found.score >= SURE and max(off) <= AGREEMENT * guess.inter_ocular_px:
        return found
    report.warn("The face cannot be read; an average face is laid on the points that were given by hand.")
    return guess


def _check_size(found: FaceLandmarks, report: Report) -> None:
    distance = found.inter_ocular_px
    size = max(found.box[2] - found.box[0], found.box[3] - found.box[1])
    reach = max(distance, 0.35 * size)
    if reach < SMALLEST_EYE_DISTANCE_PX:
        raise NoFaceError(
            f"The face is too small: its eyes are {reach:.0f} px apart, {SMALLEST_EYE_DISTANCE_PX:.0f} or more are "
            "needed; use a larger picture."
        )
    if reach < SMALL_EYE_DISTANCE_PX:
        report.warn(f"The face is small: its eyes are {reach:.0f} px apart; hair will be coarse.")


def _check_frame(found: FaceLandmarks, shape: tuple[int, ...], report: Report) -> None:
    height, width = shape
    x, y = found.points[:, 0], found.points[:, 1]
    outside = float(np.mean((x < 0) | (y < 0) | (x > width) | (y > height)))
    if outside > CUT_OFF:
        raise NoFaceError(f"The face is cut off: {outside:.0%} of it is outside the picture; use one that shows it.")
    if outside > 0.02:
        report.warn(f"The face is cut off: {outside:.0%} of it lies outside the picture and is guessed.")
