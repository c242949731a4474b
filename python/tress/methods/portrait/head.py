"""The stage `head`: the face, the person and the fitted head."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.report import Report
from tress.head.fit import FitParams, FittedHead, fit_head
from tress.head.hand_points import HandPoints
from tress.head.landmarks import FaceLandmarks
from tress.head.person import person_mask
from tress.head.read_face import read_face


@dataclass(frozen=True)
class PortraitHead:
    """The face's `landmarks`, the probability of a person at every pixel `person` (H, W) float32, the `fitted` head."""

    landmarks: FaceLandmarks
    person: NDArray[np.float32]
    fitted: FittedHead


def head_stage(
    pixels: NDArray[np.uint8],
    *,
    alpha: NDArray[np.uint8] | None = None,
    face: int | None = None,
    landmarks: HandPoints | None = None,
    params: FitParams | None = None,
    report: Report,
) -> PortraitHead:
    """The head of the person in `pixels` (H, W, 3) uint8 sRGB.

    `alpha` (H, W) uint8 of a cut-out bounds the person mask. `face` chooses among several, counted from the left
    from 0; `landmarks` are given by hand. Raises the errors of `read_face`.
    """
    points = read_face(pixels, face=face, landmarks=landmarks, report=report)
    report.progress(0.5)
    person = person_mask(pixels, landmarks=points)
    if alpha is not None:
        person = np.minimum(person, alpha.astype(np.float32) / np.float32(255))
    fitted = fit_head(points, person_mask=person, params=params)
    report.number("eye_distance_px", round(fitted.inter_ocular_px, 1))
    report.number("error_percent_of_eye_distance", round(100 * fitted.error_of_eye_distance, 2))
    for name, angle in (("yaw", fitted.yaw), ("pitch", fitted.pitch), ("roll", fitted.roll)):
        report.number(f"{name}_degrees", round(float(np.degrees(angle)), 1))
    return PortraitHead(points, person, fitted)
