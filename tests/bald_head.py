"""A painted photograph of a bald person: the mean head of the statistical model on a plain body."""

import cv2
import numpy as np
from PIL import Image

from tress.head.assets import asset

SIZE = 480
PX_PER_METRE = 900.0
SKIN = np.array([0.58, 0.36, 0.27])


def bald_head() -> Image.Image:
    """480 x 480 px: skin and lips, a blue shirt, a grey wall."""
    with np.load(asset("head.npz")) as model:
        positions, triangles = model["mean"].astype(float), model["triangles"]
        masks = {name: model[f"mask_{name}"][:, None] for name in ("lips", "inside")}
    colors = np.broadcast_to(SKIN, positions.shape)
    colors = colors + masks["lips"] * (SKIN * [0.8, 0.5, 0.5] - SKIN)
    colors = colors + masks["inside"] * ([0.05, 0.02, 0.02] - colors)
    linear = _painted(positions, triangles, colors)
    encoded = np.clip(linear, 0, 1) ** (1 / 2.2) * 255 + np.random.default_rng(0).normal(0, 2, linear.shape)
    return Image.fromarray(np.clip(encoded, 0, 255).astype(np.uint8))


def _painted(positions: np.ndarray, triangles: np.ndarray, colors: np.ndarray) -> np.ndarray:
    """The triangles from far to near, flatly shaded, over wall and shirt."""
    picture = np.full((SIZE, SIZE, 3), 0.35)
    cv2.ellipse(picture, (SIZE // 2, SIZE + 20), (SIZE // 2 - 40, 130), 0, 0, 360, (0.03, 0.05, 0.15), -1, cv2.LINE_AA)
    corners = positions[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True).clip(1e-12)
    light = np.array([0.35, 0.4, 0.85])
    shade = 0.35 + 0.75 * np.clip(normals @ (light / np.linalg.norm(light)), 0, 1)
    tones = colors[triangles].mean(axis=1) * shade[:, None]
    xy = positions[:, :2] * [PX_PER_METRE, -PX_PER_METRE] + [SIZE / 2, SIZE * 0.45]
    for triangle in np.argsort(corners[:, :, 2].mean(axis=1)):
        if normals[triangle, 2] > 0:
            cv2.fillConvexPoly(picture, np.rint(xy[triangles[triangle]]).astype(np.int32), tones[triangle].tolist())
    return cv2.GaussianBlur(picture, (0, 0), 0.8)
