"""The one distant light of the lit styles, placed by the camera."""

from typing import Any

import numpy as np

from tress.render.gbuffer import GBuffer

Array = np.ndarray[Any, Any]

_UP = np.array([0.0, 1.0, 0.0])


def light_direction(gbuffer: GBuffer, *, azimuth_rad: float, elevation_rad: float) -> Array:
    """(3,) float64 unit direction in the world to a light to the right of the camera and above it."""
    back = -gbuffer.away
    right = np.cross(_UP, back)
    right = right / np.linalg.norm(right) if np.linalg.norm(right) > 1e-6 else np.array([1.0, 0, 0])
    up = np.cross(back, right)
    level = np.cos(azimuth_rad) * back + np.sin(azimuth_rad) * right
    return np.cos(elevation_rad) * level + np.sin(elevation_rad) * up
