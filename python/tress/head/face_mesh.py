"""Landmarks by MediaPipe's face-mesh network: a turned crop, 468 points, and a second look through a better crop.

Source: Kartynnik et al. 2019, Real-time Facial Surface Geometry from Monocular Video on Mobile GPUs.
"""

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from tress.head.assets import asset
from tress.head.crop import Crop
from tress.head.face import FaceBox
from tress.head.landmarks import COUNT, LEFT_EYE_CORNERS, RIGHT_EYE_CORNERS, FaceLandmarks
from tress.head.network import LandmarkModel, Network

SIDE = 192
MARGIN = 1.5
"""Side of the crop over the side of the box, as the network was trained."""


class OpenCvLandmarkModel:
    """The built face-mesh network, or another TFLite file of the same form."""

    def __init__(self, path: Path | None = None) -> None:
        self._network = Network(path or asset("face_landmark.tflite"))

    def landmarks(self, image: NDArray[np.uint8], crop: Crop) -> FaceLandmarks:
        """The points of the face that fills `crop` of `image` (H, W, 3) uint8 sRGB. About 5 ms."""
        pixels = crop.pixels(image, side=SIDE)
        batch = cv2.dnn.blobFromImage(pixels, 1 / 255.0, (SIDE, SIDE))
        raw, flag = self._network(np.asarray(batch, np.float32))[:2]
        unit = raw.reshape(-1, 3)[:COUNT].astype(np.float64) / SIDE
        points = np.column_stack([crop.to_image(unit[:, :2]), -unit[:, 2] * crop.size])
        score = float(expit(float(flag.ravel()[0])))
        return FaceLandmarks(points.astype(np.float32), score, np.ones(COUNT, np.float32))


def locate_landmarks(
    image: NDArray[np.uint8], face: FaceBox, *, model: LandmarkModel, passes: int = 2
) -> FaceLandmarks:
    """The 468 points of `face`; each further pass looks through the crop that the points before it suggest."""
    points = model.landmarks(image, crop_of_face(face))
    for _ in range(passes - 1):
        points = model.landmarks(image, crop_of_landmarks(points))
    return points


def crop_of_face(face: FaceBox) -> Crop:
    """The crop for a detected face: eyes level, half as much again around its box."""
    right, left = face.keypoints[:2]
    x, y = face.center
    return Crop((float(x), float(y)), MARGIN * face.size, _angle(right, left))


def crop_of_landmarks(landmarks: FaceLandmarks) -> Crop:
    """The crop around known points: eyes level, half as much again around their box in that turn."""
    points = landmarks.points[:, :2].astype(np.float64)
    angle = _angle(points[RIGHT_EYE_CORNERS[0]], points[LEFT_EYE_CORNERS[0]])
    cos, sin = np.cos(angle), np.sin(angle)
    axes = np.array([[cos, -sin], [sin, cos]])
    level = points @ axes
    low, high = level.min(axis=0), level.max(axis=0)
    x, y = axes @ ((low + high) / 2)
    return Crop((float(x), float(y)), MARGIN * float((high - low).max()), angle)


def _angle(right_eye: NDArray[np.floating], left_eye: NDArray[np.floating]) -> float:
    dx, dy = np.asarray(left_eye, np.float64) - right_eye
    return float(np.arctan2(dy, dx))
