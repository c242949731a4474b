"""The camera of a photograph."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.model.record import Record, array
from tress.model.similarity import similarity


@dataclass(frozen=True, eq=False)
class Camera(Record):
    """An affine camera: pixel (x, y, 1) = `xy_from_world` @ (X, Y, Z, 1), with last row 0 0 0 1.

    Pixels: x to the right, y down, first pixel centre at (0.5, 0.5). Raises `InputError` where the last row differs, or
    width or height is not positive.

    >>> camera = Camera(xy_from_world=[[100, 0, 0, 50], [0, -100, 0, 50], [0, 0, 0, 1]], width=100, height=100)
    >>> camera.project(np.array([[0.0, 0.25, 9.0]]))
    array([[50., 25.]])
    """

    width: int
    height: int
    xy_from_world: np.ndarray[Any, Any] = array("f8", 3, 4, doc="Pixels from metres, affine.")

    def check(self) -> None:
        """Affine, and a picture with pixels."""
        if not np.array_equal(self.xy_from_world[2], (0, 0, 0, 1)):
            raise InputError(f"Camera.xy_from_world has last row {self.xy_from_world[2]}; 0 0 0 1 was expected.")
        if self.width <= 0 or self.height <= 0:
            raise InputError(f"Camera is {self.width} x {self.height} pixels; positive numbers were expected.")

    def transformed(self, new_from_old: np.ndarray[Any, Any]) -> "Camera":
        """The camera elsewhere, that sees of the transformed world what it saw before."""
        old_from_new = np.linalg.inv(similarity(new_from_old).matrix)
        xy_from_new = np.vstack([self.xy_from_world[:2] @ old_from_new, [0, 0, 0, 1]])
        return replace(self, xy_from_world=xy_from_new)

    def project(self, points_in_world: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        """(N, 2) float64 pixels of (N, 3) points in metres."""
        return points_in_world @ self.xy_from_world[:2, :3].T + self.xy_from_world[:2, 3]
