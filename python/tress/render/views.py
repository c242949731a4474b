"""Cameras for looking at hair from around."""

from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.model.camera import Camera
from tress.render.flat_scene import FlatScene

Array = np.ndarray[Any, Any]


def turned(camera: Camera, *, angle_rad: float, pivot_in_world: Array) -> Camera:
    """The camera with the scene turned by `angle_rad` about the upright axis (world Y) through a pivot.

    Positive angles show more of the scene's right-hand side (its +X side comes to the front).
    """
    cos, sin = np.cos(-angle_rad), np.sin(-angle_rad)
    rotation = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    pivot = np.asarray(pivot_in_world, np.float64)
    turned_from_world = np.eye(4)
    turned_from_world[:3, :3] = rotation
    turned_from_world[:3, 3] = pivot - rotation @ pivot
    return Camera(xy_from_world=camera.xy_from_world @ turned_from_world, width=camera.width, height=camera.height)


def framed(scene: FlatScene, *, width: int, height: int, margin: float = 0.05) -> Camera:
    """An orthographic camera from the front (along -Z) that keeps the hair, and the head behind it, in the picture.

    The frame is that of the cylinder around the hair and so fits from every side; where a mesh goes on below the hair
    (neck, shoulders) it is cut off. `margin` is the empty part on either side. Raises `InputError` for an empty scene.
    """
    low, high, radius, centre = _cylinder(scene)
    inside = 1 - 2 * margin
    scale = min(inside * width / (2 * radius), inside * height / (high - low))
    middle = 0.5 * (low + high)
    matrix = [
        [scale, 0, 0, 0.5 * width - scale * centre[0]],
        [0, -scale, 0, 0.5 * height + scale * middle],
        [0, 0, 0, 1],
    ]
    return Camera(xy_from_world=np.array(matrix), width=width, height=height)


def pivot(scene: FlatScene) -> Array:
    """(3,) float64: the middle of the head if there is one, else of the hair: where turntables turn."""
    if len(scene.points) + len(scene.positions) == 0:
        raise InputError("The scene is empty; strands or a mesh were expected.")
    body = scene.positions if len(scene.positions) else scene.points
    upper = body[body[:, 1] >= np.median(body[:, 1])]
    return np.asarray(0.5 * (upper.min(axis=0) + upper.max(axis=0)), np.float64)


def _cylinder(scene: FlatScene) -> tuple[float, float, float, Array]:
    """Lowest and highest Y, radius about the pivot, pivot. Stray hairs (1 in 500) may leave the frame."""
    centre = pivot(scene)
    parts = [scene.points] if len(scene.points) else []
    parts += [scene.positions] if len(scene.positions) else []
    low, high, radius = np.inf, -np.inf, 0.0
    for part in parts:
        if len(scene.points) and part is scene.positions:
            part = part[part[:, 1] > scene.points[:, 1].min()]
        if len(part) == 0:
            continue
        bottom, top = np.quantile(part[:, 1], [0.002, 0.998])
        low, high = min(low, float(bottom)), max(high, float(top))
        radius = max(radius, float(np.quantile(np.hypot(*(part - centre)[:, [0, 2]].T), 0.998)))
    if len(scene.positions):
        low = min(low, float(max(scene.positions[:, 1].min(), centre[1] - 1.3 * radius)))
    return low, max(high, low + 1e-3), max(radius, 1e-3), centre
