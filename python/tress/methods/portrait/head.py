"""The stage `head`: the face, the person and the fitted head."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError, NoFaceError
from tress.base.report import Report
from tress.head.detector import OpenCvFaceDetector, find_faces
from tress.head.face_mesh import OpenCvLandmarkModel, locate_landmarks
from tress.head.fit import FitParams, FittedHead, fit_head
from tress.head.landmarks import FaceLandmarks
from tress.head.person import person_mask

_LEAST_SCORE = 0.5
_LEAST_INTER_OCULAR_PX = 12.0
_HELP = "use a larger or more frontal photo of one face, or give its points with --landmarks"


@dataclass(frozen=True)
class PortraitHead:
    """The face's `landmarks`, the probability of a person at every pixel `person` (H, W) float32, the `fitted` head."""

    landmarks: FaceLandmarks
    person: NDArray[np.float32]
    fitted: FittedHead


def portrait_head(
    pixels: NDArray[np.uint8],
    *,
    alpha: NDArray[np.uint8] | None,
    face: int | None,
    landmarks: FaceLandmarks | None,
    params: FitParams,
    report: Report,
) -> PortraitHead:
    """The head of the person in `pixels` (H, W, 3) uint8 sRGB.

    `alpha` (H, W) uint8 of a cut-out stands for the person mask. `face` chooses among several, 0 the largest, which is
    also taken without it. `landmarks` replace the detector's. Raises `NoFaceError` where no face is found, or one too
    small to be fitted; `InputError` where `face` is more than there are.
    """
    points = landmarks or _detected(pixels, face=face, report=report)
    if points.inter_ocular_px < _LEAST_INTER_OCULAR_PX:
        raise NoFaceError(f"The eyes are {points.inter_ocular_px:.0f} px apart, too close to fit a head; {_HELP}.")
    person = person_mask(pixels, landmarks=points) if alpha is None else alpha.astype(np.float32) / np.float32(255)
    fitted = fit_head(points, person_mask=person, params=params)
    report.number("inter_ocular_px", round(fitted.inter_ocular_px, 1))
    report.number("fit_error_percent", round(100 * fitted.error_of_eye_distance, 2))
    report.number("yaw_degrees", round(float(np.degrees(fitted.yaw)), 1))
    report.number("pitch_degrees", round(float(np.degrees(fitted.pitch)), 1))
    report.number("roll_degrees", round(float(np.degrees(fitted.roll)), 1))
    return PortraitHead(points, person, fitted)


def _detected(pixels: NDArray[np.uint8], *, face: int | None, report: Report) -> FaceLandmarks:
    model = OpenCvLandmarkModel()
    found = [locate_landmarks(pixels, box, model=model) for box in find_faces(pixels, detector=OpenCvFaceDetector())]
    faces = sorted((points for points in found if points.score >= _LEAST_SCORE), key=_size, reverse=True)
    report.number("faces", len(faces))
    if not faces:
        raise NoFaceError(f"No face was found in the photo; {_HELP}.")
    return _chosen(faces, face, report)


def _chosen(faces: list[FaceLandmarks], face: int | None, report: Report) -> FaceLandmarks:
    if face is not None and face >= len(faces):
        raise InputError(f"--face {face} is not there: {len(faces)} found, counted from 0, the largest first.")
    if face is None and len(faces) > 1:
        report.warn(f"{len(faces)} faces were found and the largest was taken; --face 1 takes the next.")
    return faces[face or 0]


def _size(face: FaceLandmarks) -> float:
    x0, y0, x1, y1 = face.box
    return max(x1 - x0, y1 - y0)
