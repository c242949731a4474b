"""Where each layer of a portrait may lie: a location prior from the face's landmarks and the person mask.

The landmarks give a frame for the head (right, up, towards the camera, and its size), the frame gives an ellipsoid for
the cranium that turns with the head, and both together a few zones: the face, the forehead above it, the cap of the
cranium, the sides, the throat, the chest. Each zone has a plain opinion on hair, face and body; the person mask gives
the one on the background.

Lengths are in face heights (chin to the top of the landmarks' forehead, about 0.17 m). Source of proportions: mean
adult head (height 0.225 m, breadth 0.152 m, length 0.195 m).
"""

from dataclasses import dataclass
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.head.landmarks import CHIN, FOREHEAD, FaceLandmarks
from tress.image.labels import BACKGROUND, BODY, FACE, HAIR, LAYER_COUNT

HEAD_HEIGHT: Final = 1.3
"""Chin to crown."""
_WORK_SIZE: Final = 320
_RIGHT_SIDE, _LEFT_SIDE = 234, 454
_BROWS: Final = (70, 63, 105, 66, 107, 336, 296, 334, 293, 300)
_CRANIUM_RADII: Final = np.array([0.45, 0.58, 0.57])
"""Half breadth, height, length of the cranium."""
_CRANIUM_ABOVE_EARS: Final = 0.22
_CRANIUM_BEHIND_EARS: Final = 0.12
_PER_FAR: Final = 2.0
_MOST_FAR: Final = 0.6
"""Logarithm of odds against the person for each radius of the cranium that a place is farther out, up to the most."""
_EAR_BEHIND_SIDE: Final = 0.15
_EAR_RADIUS: Final = 0.16
_EYES: Final = (
    (33, 7, 163, 144, 145, 153, 154, 155, 133, 173, 157, 158, 159, 160, 161, 246, 46, 53, 52, 65, 55),
    (263, 249, 390, 373, 374, 380, 381, 382, 362, 398, 384, 385, 386, 387, 388, 466, 276, 283, 282, 295, 285),
)
"""Each eye with the lower rim of its brow."""
_NOSE: Final = (168, 6, 197, 195, 5, 4, 1, 19, 94, 2, 98, 327, 129, 358)
_MOUTH: Final = (61, 185, 40, 39, 37, 0, 267, 269, 270, 409, 291, 375, 321, 405, 314, 17, 84, 181, 91, 146)
_GLASSES_BEFORE_EYES: Final = 0.1
_FEATURE_RIM: Final = 0.05
"""How far eyes, nose and mouth reach beyond their points."""


@dataclass(frozen=True)
class FaceFrame:
    """The head's frame in the picture: `axes` (3, 3) rows right, up, towards the camera, of unit length, in px
    directions (x, y, z); `height_px` from chin to forehead; `eyes` (2,) px, between the eyes; `ears` (2, 2) px;
    `cranium` (2,) px and `spread` (2, 2) px², the centre and the matrix of the outline ellipse of the bare cranium."""

    axes: NDArray[np.float64]
    height_px: float
    eyes: NDArray[np.float64]
    ears: NDArray[np.float64]
    cranium: NDArray[np.float64]
    spread: NDArray[np.float64]


def face_frame(landmarks: FaceLandmarks) -> FaceFrame:
    """The frame of a face from its 468 points, whatever its turn and tilt."""
    points = landmarks.points.astype(np.float64)
    up = points[FOREHEAD] - points[CHIN]
    across = points[_LEFT_SIDE] - points[_RIGHT_SIDE]
    height = float(np.linalg.norm(up))
    up = up / height
    across -= up * (across @ up)
    right = across / np.linalg.norm(across)
    forward = np.cross(right, up) * (-1 if np.cross(right, up)[2] < 0 else 1)
    axes = np.stack([right, up, forward])
    sides = points[[_RIGHT_SIDE, _LEFT_SIDE]]
    ears = sides - height * _EAR_BEHIND_SIDE * forward - height * 0.01 * up
    center = sides.mean(axis=0) + height * (_CRANIUM_ABOVE_EARS * up - _CRANIUM_BEHIND_EARS * forward)
    radii = height * _CRANIUM_RADII
    spread = (axes.T @ np.diag(radii**2) @ axes)[:2, :2]
    return FaceFrame(axes, height, landmarks.eyes.mean(axis=0), ears[:, :2], center[:2], spread)


def location_prior(landmarks: FaceLandmarks, *, person: NDArray[np.float32]) -> NDArray[np.float32]:
    """Prior (H, W, 4) float32 of background, body, face and hair, adding up to 1, for a person mask (H, W) in [0, 1].

    Cost: about 30 ms for 1000 x 1000 pixels. Limits: knows no hats, hands or second persons.
    """
    height, width = person.shape
    scale = min(1.0, _WORK_SIZE / max(height, width))
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    zones = _zones(landmarks, face_frame(landmarks), size, scale)
    inside = _of_person(zones)
    small = np.asarray(cv2.resize(person, size, interpolation=cv2.INTER_AREA), np.float32)
    mask = _sharpened(np.clip(small, 0.003, 0.997), zones)
    prior = np.empty((size[1], size[0], LAYER_COUNT), np.float32)
    prior[..., 1:] = inside * mask[..., None]
    prior[..., BACKGROUND] = 1 - mask
    full = cv2.resize(prior, (width, height), interpolation=cv2.INTER_LINEAR)
    return np.asarray(full, np.float32)


@dataclass(frozen=True)
class _Zones:
    """Coordinates of every pixel (h, w), in face heights: `along` right and `above` the eyes, `outside` the face's
    outline (negative inside), `over_brows` above the brow line, `cranium` (1 on the bare cranium's outline); `ears` and
    `features` (eyes, glasses, nose, mouth) in [0, 1]."""

    along: NDArray[np.float32]
    above: NDArray[np.float32]
    outside: NDArray[np.float32]
    over_brows: NDArray[np.float32]
    cranium: NDArray[np.float32]
    ears: NDArray[np.float32]
    features: NDArray[np.float32]


def _sharpened(mask: NDArray[np.floating], zones: _Zones) -> NDArray[np.float32]:
    """The person mask, where it is in doubt, less the farther from the cranium above the chin: a small head's mask is
    wider than the head."""
    far = np.clip(zones.cranium - 1.1, 0, _MOST_FAR) * _step(zones.above, -0.7, -0.4)
    odds = np.log(mask / (1 - mask)) - _PER_FAR * far
    return np.asarray(1 / (1 + np.exp(-odds)), np.float32)


def _zones(landmarks: FaceLandmarks, frame: FaceFrame, size: tuple[int, int], scale: float) -> _Zones:
    columns, rows = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    place = np.stack([columns, rows], axis=-1) / scale
    up = frame.axes[1, :2] / max(1e-9, float(np.linalg.norm(frame.axes[1, :2])))
    right = np.array([-up[1], up[0]])
    brows = landmarks.points[list(_BROWS), :2].mean(axis=0) - frame.eyes
    away = (place - frame.eyes) / frame.height_px
    off = place - frame.cranium
    cranium = np.sqrt(np.einsum("hwi,ij,hwj->hw", off, np.linalg.inv(frame.spread), off))
    above = away @ up
    over_brows = above - brows @ up / frame.height_px
    unit = frame.height_px * scale
    outside = _distance_outside([landmarks.points[:, :2] * scale], size) / unit
    features = _distance_outside([part * scale for part in _feature_points(landmarks, frame)], size) / unit
    near = _step(-features, -_FEATURE_RIM, 0.0)
    zones = (away @ right, above, outside, over_brows, cranium, _ears(place, frame), near)
    return _Zones(*(np.asarray(zone, np.float32) for zone in zones))


def _feature_points(landmarks: FaceLandmarks, frame: FaceFrame) -> list[NDArray[np.floating]]:
    """Points (K, 2) px around each eye with its glasses, the nose and the mouth."""
    points = landmarks.points[:, :2]
    before = _GLASSES_BEFORE_EYES * frame.height_px * frame.axes[2, :2]
    eyes = [np.concatenate([points[list(eye)], points[list(eye)] + before]) for eye in _EYES]
    return [*eyes, points[list(_NOSE)], points[list(_MOUTH)]]


def _ears(place: NDArray[np.floating], frame: FaceFrame) -> NDArray[np.float64]:
    """1 on the two ears, 0 far from them."""
    bumps = [
        np.exp(-((((place - ear) / (_EAR_RADIUS * frame.height_px)) ** 2).sum(axis=-1) ** 2)) for ear in frame.ears
    ]
    return np.maximum(*bumps)


def _distance_outside(parts: list[NDArray[np.floating]], size: tuple[int, int]) -> NDArray[np.float32]:
    """Distance (h, w) from the convex hulls of points (K, 2), negative inside them."""
    inside = np.zeros((size[1], size[0]), np.uint8)
    for points in parts:
        cv2.fillConvexPoly(inside, cv2.convexHull(np.rint(points - 0.5).astype(np.int32)), 1)
    out = cv2.distanceTransform(1 - inside, cv2.DIST_L2, 5)
    deep = cv2.distanceTransform(inside, cv2.DIST_L2, 5)
    return np.asarray(out - deep, np.float32)


def _of_person(zones: _Zones) -> NDArray[np.float32]:
    """Body, face and hair (h, w, 3), adding up to 1: what a pixel of the person may be."""
    prior = _around_face(zones)
    prior = _blend(prior, _in_face(zones), _step(-zones.outside, 0.0, 0.02))
    prior = _blend(prior, _constant(zones.features, 0.0, 1.0, 0.0), zones.features)
    return np.asarray(prior / prior.sum(axis=-1, keepdims=True), np.float32)


def _around_face(zones: _Zones) -> NDArray[np.float32]:
    beside = _sides(zones)
    over = _cap(zones)
    under = _below_chin(zones)
    prior = _blend(beside, over, _step(zones.above, -0.1, 0.15))
    prior = _blend(prior, _constant(zones.ears, 0.03, 0.6, 0.37), zones.ears)
    return _blend(prior, under, _step(-zones.above, 0.5, 0.75))


def _cap(zones: _Zones) -> NDArray[np.float32]:
    """Above the eyes: hair, with a forehead above the outline, as high as it is with a bald front; far off anything."""
    far = _step(zones.cranium, 1.5, 2.3)
    middle = np.exp(-((zones.along / 0.38) ** 4))
    forehead = (0.3 + 0.3 * middle) * np.exp(-((np.maximum(zones.outside, 0) / 0.16) ** 2))
    return _stack(0.04 + 0.5 * far, 0.03 + forehead * (1 - far), 0.93 - forehead - 0.5 * far)


def _sides(zones: _Zones) -> NDArray[np.float32]:
    """Between eyes and chin beside the face: neck near, hair, then sleeves and shoulders."""
    near = np.exp(-np.maximum(zones.outside, 0) / 0.12)
    far = _step(np.abs(zones.along), 0.7, 1.3)
    return _stack(0.2 + 0.45 * far, 0.05 + 0.45 * near, 0.6 - 0.25 * near - 0.3 * far)


def _below_chin(zones: _Zones) -> NDArray[np.float32]:
    """Throat, chest and shoulders: skin and clothes; hair hangs at the sides and gets rarer downwards."""
    throat = np.exp(-((zones.along / 0.28) ** 2)) * _step(zones.above, -1.3, -0.9)
    down = _step(-zones.above, 0.6, 2.4)
    aside = _step(np.abs(zones.along), 0.7, 1.4)
    hair = (0.5 - 0.3 * down) * (1 - 0.9 * throat) * (1 - 0.75 * aside)
    skin = 0.5 * throat + 0.06 * (1 - down)
    return _stack(1 - hair - skin, skin, hair)


def _in_face(zones: _Zones) -> NDArray[np.float32]:
    """Inside the outline: face; but a fringe may hang over the forehead and locks over the temples and cheeks."""
    fringe = 0.2 * _step(zones.over_brows, 0.0, 0.12)
    lock = 0.25 * np.exp(np.minimum(zones.outside, 0) / 0.07) * _step(zones.above, -0.45, -0.15)
    hair = np.maximum(np.maximum(fringe, lock), 0.004)
    return _stack(np.full_like(hair, 0.003), 1 - hair, hair)


def _constant(like: NDArray[np.float32], body: float, face: float, hair: float) -> NDArray[np.float32]:
    return _stack(*(np.full_like(like, part) for part in (body, face, hair)))


def _stack(body: NDArray, face: NDArray, hair: NDArray) -> NDArray[np.float32]:
    layers = {BODY: body, FACE: face, HAIR: hair}
    stacked = np.stack([layers[k] for k in (BODY, FACE, HAIR)], axis=-1)
    return np.asarray(np.maximum(stacked, 0.0005), np.float32)


def _blend(first: NDArray[np.float32], second: NDArray[np.float32], share: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.asarray(first + share[..., None] * (second - first), np.float32)


def _step(value: NDArray[np.float32], low: float, high: float) -> NDArray[np.float32]:
    """0 below `low`, 1 above `high`, smooth between."""
    t = np.clip((value - low) / (high - low), 0, 1)
    return np.asarray(t * t * (3 - 2 * t), np.float32)
