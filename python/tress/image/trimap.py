"""Where alpha is known and where it must be found: a band on both sides of a mask's border."""

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError
from tress.kernel.matting import TRIMAP_BACKGROUND, TRIMAP_FOREGROUND, TRIMAP_UNKNOWN


def trimap_of_mask(mask: NDArray[np.bool_], *, shrink_px: float, grow_px: float) -> NDArray[np.uint8]:
    """(H, W) uint8: 255 deeper than `shrink_px` inside `mask`, 0 farther than `grow_px` outside it, else 128.

    Distances are Euclidean, from pixel centre to the nearest centre of the other side; the picture's rim is no border.
    """
    if mask.ndim != 2:
        raise InputError(f"the mask has the shape {mask.shape}; (height, width) was expected.")
    inside = mask.astype(np.uint8)
    trimap = np.full(mask.shape, TRIMAP_UNKNOWN, np.uint8)
    trimap[_distance_within(inside) > shrink_px] = TRIMAP_FOREGROUND
    trimap[_distance_within(1 - inside) > grow_px] = TRIMAP_BACKGROUND
    return trimap


def _distance_within(side: NDArray[np.uint8]) -> NDArray[np.float32]:
    if side.all():
        return np.full(side.shape, np.inf, np.float32)
    return np.asarray(cv2.distanceTransform(side, cv2.DIST_L2, cv2.DIST_MASK_PRECISE), np.float32)
