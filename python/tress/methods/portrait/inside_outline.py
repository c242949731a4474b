"""Hidden hair kept within the photograph's outline: it adds nothing at the soft rim of the hair in the original view.

The rim is drawn by the strands that the photograph shows, in the opacity that its matte tells. Hidden strands from
voxels of some millimetres would stand out there, make the rim solid, and, fitted to the photograph, take on its
background's colour, which runs over the head as a seam once it turns. (Chai et al. 2012, section 3.3.2: the volume does
not add unnecessary strands when seen from the original viewpoint.)
"""

from typing import Any

import cv2
import numpy as np

from tress.image.labels import BACKGROUND, BODY, FACE
from tress.kernel import fields
from tress.methods.portrait.box import Box

Array = np.ndarray[Any, Any]

SOLID_ALPHA = 0.9
"""Hair from which on it counts as solid."""
INSET_PX = 1.0
"""Pixels that hidden hair stays within the solid hair: half a strand's width and what smooths it."""
SMOOTH = 0.004
"""Radius in metres of bumps of the outline that hidden hair leaves out; its vertices are too far apart for them."""
FARTHEST = 0.008
"""Metres that a point is moved at most; hair farther out, as of a thin lock, stays."""
CLEARANCE = 0.0005
"""Metres from the head below which no point is moved."""


def before_hidden(alpha: Array, label: Array) -> Array:
    """(H, W) bool: the pixels that hide what is behind, from the matte's `alpha` and the layers' `label` (H, W).

    Solid hair, face and body, and soft hair that is closer to these than to the background.
    """
    return (alpha > SOLID_ALPHA) | ~near_background(label)


def near_background(label: Array) -> Array:
    """(H, W) bool: pixels closer to the background than to face and body, by the layers' `label` (H, W)."""
    to_person, to_background = (
        cv2.distanceTransform((~where).astype(np.uint8), cv2.DIST_L2, 3)
        for where in (np.isin(label, (FACE, BODY)), label == BACKGROUND)
    )
    return to_background < to_person


def inside_outline(points: Array, *, solid: Array, xy_from_view: Array, head_distance: Array, box: Box) -> Array:
    """(N, 3) float32: hidden `points` in the view frame, those beside the `solid` pixels (H, W) moved to the nearest.

    Depths stay. Points that would get into the head, by its `head_distance` (L, R, C) in metres, stay as well.
    """
    inner = _smooth_inside(solid, max(1.0, SMOOTH * float(xy_from_view[0, 0]))).astype(np.uint8)
    if not inner.any():
        return points
    height, width = solid.shape
    scale, offset = np.array([xy_from_view[0, 0], xy_from_view[1, 1]]), xy_from_view[:2, 3]
    pixel = points[:, :2] * scale + offset
    column, row = (np.clip(pixel[:, k].astype(np.int64), 0, side - 1) for k, side in ((0, width), (1, height)))
    outside = np.flatnonzero(inner[row, column] == 0)
    found = cv2.distanceTransformWithLabels(1 - inner, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)[1]
    numbers = np.asarray(found, np.int64)
    pixel_of = np.zeros((int(numbers.max()) + 1, 2))
    rows, columns = np.nonzero(inner)
    pixel_of[numbers[rows, columns]] = np.stack([columns, rows], axis=1) + 0.5
    nearest = pixel_of[numbers[row[outside], column[outside]]]
    moved = np.array(points, np.float32)
    moved[outside, :2] = (nearest - offset) / scale
    near = np.linalg.norm(moved[outside] - points[outside], axis=1) <= FARTHEST
    free = fields.sample(head_distance, places=box.cells(moved[outside])) >= CLEARANCE
    kept = outside[~(near & free)]
    moved[kept] = points[kept]
    return moved


def _smooth_inside(solid: Array, radius_px: float) -> Array:
    """(H, W) bool: the `solid` pixels with their holes, without what is narrower than twice the radius, and inset."""
    filled = np.zeros(solid.shape, np.uint8)
    outlines = cv2.findContours(solid.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0]
    cv2.drawContours(filled, outlines, -1, 1, thickness=cv2.FILLED)
    padded = cv2.copyMakeBorder(filled, 1, 1, 1, 1, cv2.BORDER_REPLICATE)
    core = cv2.distanceTransform(padded, cv2.DIST_L2, 5)[1:-1, 1:-1] > radius_px
    if not core.any():
        return core
    return cv2.distanceTransform((~core).astype(np.uint8), cv2.DIST_L2, 5) <= radius_px - INSET_PX
