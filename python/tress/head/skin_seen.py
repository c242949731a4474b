"""Where the photograph shows this person's skin, and how surely, at about a millimetre a cell around the head."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.head.skin_model import SkinModel

CELL_M = 0.001
EDGE_M = (0.002, 0.010)
"""Distance from anything that is not bare skin at which the photograph begins to count, and counts fully."""
LIKELY = (4.0, 16.0)
"""Squared distance from the skin model up to which a colour is surely skin, and from which surely not."""
SPOT_M = 0.003
"""Moles and stubble up to twice as wide, with skin around them, are skin."""
SHED_M = 0.003
"""What lies this close to a colour that is no skin is none either."""
SMOOTH_M = 0.004
"""Reach of the local mean of the skin."""


@dataclass(frozen=True)
class SkinSeen:
    """Maps on cells around the head, whose first cell lies at `corner` (2,) px and which are `step` (2,) px wide.

    `bare` (h, w) in [0, 1]: well inside what is said to be bare skin. `likely` (h, w) in [0, 1]: of a skin's colour.
    `mean` (h, w, 3) sRGB in [0, 1]: the local mean of what is both, and `sure` (h, w) in [0, 1] how much there is.
    `color` (3,) sRGB in [0, 1]: the skin's median.
    """

    corner: NDArray[np.float64]
    step: NDArray[np.float64]
    bare: NDArray[np.float32]
    likely: NDArray[np.float32]
    mean: NDArray[np.float32]
    sure: NDArray[np.float32]
    color: NDArray[np.float32]

    def cells(self, xy: NDArray[np.floating]) -> NDArray[np.float32]:
        """Points (N, 2) px as columns and rows of cells (N, 2), counted from the first cell's middle."""
        corner, step = self.corner.astype(np.float32), self.step.astype(np.float32)
        return (np.asarray(xy, np.float32) - corner) / step - np.float32(0.5)


@dataclass(frozen=True)
class HeadCells:
    """The photograph `image` (h, w, 3) sRGB in [0, 1] and its bare `skin` (h, w) on cells; see `SkinSeen`."""

    corner: NDArray[np.float64]
    step: NDArray[np.float64]
    image: NDArray[np.float32]
    skin: NDArray[np.float32]


def head_cells(
    image: NDArray[np.uint8], *, skin: NDArray[np.floating] | None, xy: NDArray[np.float64], px_per_metre: float
) -> HeadCells | None:
    """The cells around the head whose vertices are seen at `xy` (V, 2) px; None where it lies outside the photograph.

    `skin` (H, W) in [0, 1] says where the photograph shows bare skin; without it all does.
    """
    high = np.array(image.shape[1::-1])
    x0, y0 = np.clip(np.floor(xy.min(axis=0)), 0, high).astype(int)
    x1, y1 = np.clip(np.ceil(xy.max(axis=0)), 0, high).astype(int)
    if x1 - x0 < 2 or y1 - y0 < 2:
        return None
    cell_px = max(1.0, CELL_M * px_per_metre)
    size = (max(1, round((x1 - x0) / cell_px)), max(1, round((y1 - y0) / cell_px)))
    small = cv2.resize(image[y0:y1, x0:x1], size, interpolation=cv2.INTER_AREA)
    bare = np.ones(small.shape[:2], np.float32)
    if skin is not None:
        part = np.ascontiguousarray(skin[y0:y1, x0:x1], np.float32)
        bare = np.asarray(cv2.resize(part, size, interpolation=cv2.INTER_AREA), np.float32)
    step = np.array([x1 - x0, y1 - y0]) / size
    return HeadCells(np.array([x0, y0], np.float64), step, small.astype(np.float32) / np.float32(255), bare)


def skin_seen(cells: HeadCells, *, model: SkinModel, px_per_metre: float) -> SkinSeen:
    """What of the cells is skin by its place, and by its colour."""
    cell_m = float(cells.step.mean()) / px_per_metre
    bare = _well_inside(cells.skin > 0.9, cell_m)
    t = (model.distance_sq(cells.image) - LIKELY[0]) / (LIKELY[1] - LIKELY[0])
    likely = np.asarray(1 - np.clip(t, 0, 1), np.float32)
    likely = np.asarray(cv2.morphologyEx(likely, cv2.MORPH_CLOSE, _disc(SPOT_M / cell_m)), np.float32)
    likely = _least_around(likely, SHED_M / cell_m)
    sure = bare * likely
    total = _blurred(np.dstack([cells.image * sure[..., None], sure]), SMOOTH_M / cell_m)
    mean = np.asarray(total[..., :3] / np.maximum(total[..., 3:], 1e-6), np.float32)
    return SkinSeen(cells.corner, cells.step, bare, likely, mean, total[..., 3], model.color)


def _well_inside(skin: NDArray[np.bool_], cell_m: float) -> NDArray[np.float32]:
    distance = cv2.distanceTransform(skin.astype(np.uint8), cv2.DIST_L2, 5) * cell_m
    t = np.clip((distance - EDGE_M[0]) / (EDGE_M[1] - EDGE_M[0]), 0, 1)
    return np.asarray(t * t * (3 - 2 * t), np.float32)


def _least_around(values: NDArray[np.float32], reach: float) -> NDArray[np.float32]:
    return _blurred(np.asarray(cv2.erode(values, _disc(reach)), np.float32), max(reach / 2, 0.5))


def _disc(reach: float) -> NDArray[np.uint8]:
    return np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * round(reach) + 1,) * 2), np.uint8)


def _blurred(values: NDArray[np.float32], sigma: float) -> NDArray[np.float32]:
    return np.asarray(cv2.GaussianBlur(values, (0, 0), max(sigma, 0.3), borderType=cv2.BORDER_REPLICATE), np.float32)
