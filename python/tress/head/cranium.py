"""The cranium: kept inside the person mask, and scaled and tilted as the user wishes."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates
from scipy.spatial.transform import Rotation

from tress.head.pose import Pose
from tress.head.statistical import StatisticalHead

GREATEST_PULL_M = 0.025
CELL_M = 0.002
"""Grain of the distance map on the head."""


def inward_pull(
    seen: NDArray[np.float64],
    pose: Pose,
    mask: "MaskDistance",
    *,
    head: StatisticalHead,
    margin: float,
    held: NDArray[np.bool_],
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
    """Which vertices of the scalp, of all that are `seen` at (V, 2) px, stick out of the person mask (less `margin`,
    metres) or are `held` (V,) at its edge since they once did, and how far they should go back.

    Returns vertices (N,), directions (N, 3) in the head frame and distances (N,) metres along them, negative for those
    that went back too far. Empty where more than half of the scalp lies outside: then the mask is not about this
    person.
    """
    vertices = np.flatnonzero(head.masks["scalp"] > 0.5)
    inside_px, *gradient = mask.at(seen[vertices])
    depth = inside_px / pose.scale - margin
    direction = np.stack(gradient, axis=1)
    direction /= np.linalg.norm(direction, axis=1, keepdims=True).clip(min=1e-9)
    out = (depth < 0) | held[vertices]
    if (inside_px < 0).mean() > 0.5:
        out[:] = False
    in_view = np.column_stack([direction[:, 0], -direction[:, 1], np.zeros(len(direction))])
    pull = np.clip(-depth, -GREATEST_PULL_M, GREATEST_PULL_M)
    return vertices[out], (in_view @ pose.rotation)[out], pull[out]


def reshaped_cranium(
    positions: NDArray[np.float64], *, head: StatisticalHead, scale: float, tilt: float
) -> NDArray[np.float64]:
    """An upright head (V, 3) whose cranium is scaled by `scale` and nodded by `tilt` radians about the skull's centre.

    The change fades out over the forehead and the ears; face and neck stay.
    """
    if scale == 1.0 and tilt == 0.0:
        return positions
    weight = cranium_weight(head)[:, None]
    pivot = np.array([0.0, positions[head.extremes[2], 1], 0.0])
    turned = Rotation.from_euler("x", tilt).apply(positions - pivot) * scale + pivot
    return positions + weight * (turned - positions)


def cranium_weight(head: StatisticalHead) -> NDArray[np.float64]:
    """1 at the crown and the back of the skull, falling smoothly to 0 at brow, ears and nape: (V,) float64."""
    brow = head.mean[head.extremes[2]]
    slanted = head.mean[:, 1] - brow[1] - 0.25 * (head.mean[:, 2] - brow[2])
    t = np.clip(slanted / 0.05, 0, 1)
    return t * t * (3 - 2 * t) * (np.arange(len(head.mean)) < head.skin_count) * (1 - head.masks["inside"])


@dataclass(frozen=True)
class MaskDistance:
    """Distance to the person mask's edge, px, positive inside, and its gradient: `layers` (3, h, w) on cells of `cells`
    px (2,), with `pad` cells around the picture, whose border is no edge."""

    layers: NDArray[np.float64]
    cells: NDArray[np.float64]
    pad: int

    def at(self, xy: NDArray[np.float64]) -> NDArray[np.float64]:
        """All layers at points (N, 2) px: (3, N)."""
        column, row = (xy / self.cells + self.pad - 0.5).T
        return np.stack([map_coordinates(layer, [row, column], order=1, mode="nearest") for layer in self.layers])


def mask_distance(mask: NDArray, *, px_per_metre: float) -> MaskDistance | None:
    """Of a person mask (H, W) in [0, 1], about 2 mm a cell on the head; None where it has no edge."""
    height, width = mask.shape
    cell = max(1.0, px_per_metre * CELL_M)
    size = (max(2, round(width / cell)), max(2, round(height / cell)))
    small = cv2.resize(np.asarray(mask, np.float32), size, interpolation=cv2.INTER_AREA)
    pad = max(size) // 2
    person = np.pad(small > 0.5, pad, mode="edge").astype(np.uint8)
    if person.min() == person.max():
        return None
    distance = cv2.distanceTransform(person, cv2.DIST_L2, 5) - cv2.distanceTransform(1 - person, cv2.DIST_L2, 5)
    distance = cv2.GaussianBlur(np.asarray(distance, np.float32), (0, 0), 1.0)
    cells = np.array([width / size[0], height / size[1]])
    dy, dx = np.gradient(distance)
    return MaskDistance(np.stack([distance * cells.mean(), dx, dy]).astype(np.float64), cells, pad)
