"""A turned square of a picture, as the networks want to see it."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Crop:
    """A square of `size` px around `center` (x, y), turned by `angle` radians (clockwise on the screen).

    >>> crop = Crop(center=(50.0, 40.0), size=20.0, angle=0.0)
    >>> crop.to_image(np.array([[0.5, 0.5], [0.0, 0.0]])).tolist()
    [[50.0, 40.0], [40.0, 30.0]]
    """

    center: tuple[float, float]
    size: float
    angle: float

    def to_image(self, points: NDArray[np.floating]) -> NDArray[np.float64]:
        """Points (N, 2) of the unit square, as px of the picture (N, 2)."""
        return (np.asarray(points, np.float64) - 0.5) * self.size @ self._axes() + np.array(self.center)

    def pixels(self, image: NDArray[np.uint8], *, side: int) -> NDArray[np.uint8]:
        """The square's content at `side` x `side` pixels (side, side, C); what lies outside the picture is black.

        Large crops are first shrunk by area, so that nothing aliases.
        """
        shrink = min(1.0, 2.0 * side / self.size)
        if shrink < 1.0:
            height, width = image.shape[:2]
            small = (max(1, round(width * shrink)), max(1, round(height * shrink)))
            image = cv2.resize(image, small, interpolation=cv2.INTER_AREA).astype(np.uint8)
            scale = np.array([small[0] / width, small[1] / height])
        else:
            scale = np.ones(2)
        matrix = self._image_from_pixel(side, scale)
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        return cv2.warpAffine(image, matrix, (side, side), flags=flags).astype(np.uint8)

    def _axes(self) -> NDArray[np.float64]:
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        return np.array([[cos, sin], [-sin, cos]])

    def _image_from_pixel(self, side: int, scale: NDArray[np.float64]) -> NDArray[np.float64]:
        linear = (self._axes() * (self.size / side)).T
        offset = np.array(self.center) - linear @ np.full(2, side / 2)
        linear, offset = linear * scale[:, None], offset * scale
        return np.column_stack([linear, linear @ np.full(2, 0.5) + offset - 0.5])
