"""The colour of hair where the photograph shows nothing else: its rim takes after what lies next to it inside.

At soft edges the matte's colour is a guess between hair and background. In the photo's own view that is right by
construction; seen from the side it would run over the head as a seam in the background's colour.
"""

from typing import Any

import cv2
import numpy as np

Array = np.ndarray[Any, Any]

RIM = 0.004
"""Metres of the hair's edge whose colours are not trusted."""
LEAST_CORE = 0.2
"""Share of the solid hair that is left without its rim at least."""


def hair_core(solid: Array, *, px_per_metre: float) -> Array:
    """(H, W) bool: the solid hair without its rim, or with a narrower one where next to none would be left."""
    rim_px = max(1, round(RIM * px_per_metre))
    while rim_px > 0:
        disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * rim_px + 1, 2 * rim_px + 1))
        core = cv2.erode(solid.astype(np.uint8), disc, borderType=cv2.BORDER_REPLICATE) > 0
        if core.sum() > LEAST_CORE * solid.sum():
            return core
        rim_px //= 2
    return solid


def clean_color(foreground: Array, solid: Array, *, px_per_metre: float) -> Array:
    """(H, W, 3) float32: `foreground` (H, W, 3) in the middle of the `solid` hair (H, W) bool; elsewhere the colour of
    the nearest pixel there.
    """
    picture = np.asarray(foreground, np.float32)
    core = hair_core(solid, px_per_metre=px_per_metre)
    if not core.any():
        return picture
    outside = (~core).astype(np.uint8)
    numbers = cv2.distanceTransformWithLabels(outside, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)[1]
    labels = np.asarray(numbers, np.int64)
    color_of_label = np.zeros((int(labels.max()) + 1, 3), np.float32)
    blurred = _mean_of_core(picture, core)
    color_of_label[labels[core]] = blurred[core]
    return np.where(core[..., None], picture, color_of_label[labels])


def _mean_of_core(picture: Array, core: Array) -> Array:
    """(H, W, 3) float32: mean of the pixels of `core` near by."""
    inside = core.astype(np.float32)
    share = cv2.GaussianBlur(inside, (0, 0), 2.0)[..., None]
    return cv2.GaussianBlur(picture * inside[..., None], (0, 0), 2.0) / np.maximum(share, 1e-4)
