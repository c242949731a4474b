"""Whether what was taken for hair is bare skin: a bald head, whose crown lies where hair would.

Hair may have the colour of skin, and it may be smooth; it is hardly ever both. Colour is compared in Lab between the
medians of the two regions, smoothness as the median of what a small blur takes away, so that edges and glints count
little. Limits: a shaven head with dark stubble counts as hair; the colours of a black-and-white photo tell little.
"""

from dataclasses import dataclass
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.head.landmarks import FaceLandmarks
from tress.image.labels import FACE, HAIR
from tress.methods.portrait.priors import face_frame

_FACE_HEIGHT_PX: Final = 120.0
"""Height of the face at which it is compared: pores and noise are gone, locks are not."""
_BLUR_PX: Final = 1.5
_LIGHTER, _DARKER, _CHROMA, _ROUGHER = 18.0, 12.0, 6.0, 1.15
_FEWEST: Final = 50


@dataclass(frozen=True)
class SkinLikeness:
    """Hair against the skin of the face: how much `lighter` (L of Lab), how far its `chroma` (distance in a, b), and
    how many times as `rough`."""

    lighter: float
    chroma: float
    rough: float

    @property
    def is_skin(self) -> bool:
        """Whether the one cannot be told from the other."""
        return -_DARKER < self.lighter < _LIGHTER and self.chroma < _CHROMA and self.rough < _ROUGHER


def skin_likeness(
    pixels: NDArray[np.uint8], *, label: NDArray[np.uint8], landmarks: FaceLandmarks
) -> SkinLikeness | None:
    """The layer of hair in `label` (H, W) against the face within `landmarks`; None where either is too small to tell.

    `pixels` (H, W, 3) uint8 sRGB. Cost: some milliseconds.
    """
    scale = min(1.0, _FACE_HEIGHT_PX / face_frame(landmarks).height_px)
    size = (max(1, round(pixels.shape[1] * scale)), max(1, round(pixels.shape[0] * scale)))
    small = np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), np.float32) / np.float32(255)
    lab = np.asarray(cv2.cvtColor(small, cv2.COLOR_RGB2LAB))
    layer = np.asarray(cv2.resize(label, size, interpolation=cv2.INTER_NEAREST))
    hair = cv2.erode((layer == HAIR).astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    skin = _within(landmarks, scale, layer.shape) & (layer == FACE)
    if min(hair.sum(), skin.sum()) < _FEWEST:
        return None
    rough = np.abs(lab[..., 0] - cv2.GaussianBlur(lab[..., 0], (0, 0), _BLUR_PX))
    difference = np.median(lab[hair], axis=0) - np.median(lab[skin], axis=0)
    return SkinLikeness(
        lighter=float(difference[0]),
        chroma=float(np.hypot(difference[1], difference[2])),
        rough=float(np.median(rough[hair]) / max(float(np.median(rough[skin])), 1e-3)),
    )


def _within(landmarks: FaceLandmarks, scale: float, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """The convex hull of the landmarks."""
    hull = cv2.convexHull(np.rint(landmarks.points[:, :2] * scale).astype(np.int32))
    filled = np.zeros(shape[:2], np.uint8)
    cv2.fillConvexPoly(filled, hull, 1)
    return filled > 0
