"""Painted pictures of random heads, good enough for the landmark network: skin, lips, irises, brows, a cap of hair."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tools.assets.zbuffer import Visible, visible

SIZE = 320
FACE_PX = 150
"""Pixels from chin to brow, about."""
PX_PER_METRE = FACE_PX / 0.125
IRIS_RADIUS_M = 0.0058
PUPIL_RADIUS_M = 0.0022
BROW_RISE_M = (0.013, 0.020)
BROW_REACH_M = (0.012, 0.025)
"""How far a brow goes from above the eye's centre towards the nose and towards the ear."""


@dataclass(frozen=True)
class Subject:
    """What all pictures share: the mean head at rest (V, 3) metres, its triangles, masks and eyeballs' vertices."""

    rest: NDArray[np.float64]
    triangles: NDArray[np.int64]
    masks: Mapping[str, NDArray[np.float32]]
    eyeballs: NDArray[np.bool_]

    @property
    def eyes(self) -> NDArray[np.float64]:
        """Centres of the eyeballs at rest (2, 3), smaller x first."""
        x = self.rest[:, 0]
        return np.stack(
            [self.rest[self.eyeballs & (x < 0)].mean(axis=0), self.rest[self.eyeballs & (x > 0)].mean(axis=0)]
        )


@dataclass(frozen=True)
class Portrait:
    """`image` (S, S, 3) uint8, what shows where, and the head's turn: yaw and pitch in radians."""

    image: NDArray[np.uint8]
    shown: Visible
    points: NDArray[np.float64]
    yaw: float
    pitch: float


def portrait(subject: Subject, head: NDArray[np.float64], rng: np.random.Generator) -> Portrait:
    """A picture of `head` (V, 3), metres, at a random turn (yaw within 30°, pitch within 12°), light and tone."""
    yaw, pitch = np.radians(rng.uniform(-30, 30)), np.radians(rng.uniform(-12, 12))
    turned = head @ turn(yaw, pitch).T
    points = turned * [PX_PER_METRE, -PX_PER_METRE, PX_PER_METRE] + [SIZE / 2, SIZE / 2, 0]
    shown = visible(points, subject.triangles, size=SIZE)
    some = shown.triangle >= 0
    place = _Place(subject, shown.triangle[some], shown.barycentric[some])
    colour = _painted(place, rng) * _lit(turned, subject.triangles, place, rng)[:, None]
    background = rng.uniform(0.1, 0.9, 3)
    image = np.broadcast_to(background, (SIZE, SIZE, 3)).copy()
    image[some] = colour
    image = np.clip(image, 0, 1) ** (1 / 2.2) * 255 + rng.normal(0, 3, image.shape)
    return Portrait(np.clip(image, 0, 255).astype(np.uint8), shown, points, float(yaw), float(pitch))


def turn(yaw: float, pitch: float) -> NDArray[np.float64]:
    """Rotation (3, 3): first the head nods by `pitch` (down positive), then turns by `yaw` (to its left positive)."""
    cos_y, sin_y, cos_p, sin_p = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch)
    about_y = np.array([[cos_y, 0, sin_y], [0, 1, 0], [-sin_y, 0, cos_y]])
    about_x = np.array([[1, 0, 0], [0, cos_p, -sin_p], [0, sin_p, cos_p]])
    return about_y @ about_x


class _Place:
    """The surface points behind the pixels: interpolation of anything given at the vertices."""

    def __init__(self, subject: Subject, triangle: NDArray[np.int64], weights: NDArray[np.float64]) -> None:
        self.subject = subject
        self._corners = subject.triangles[triangle]
        self._weights = weights
        self.on_eyeball = subject.eyeballs[self._corners[:, 0]]

    def of(self, values: NDArray) -> NDArray[np.float64]:
        return np.einsum("nk,nk...->n...", self._weights, values[self._corners])


def _painted(place: _Place, rng: np.random.Generator) -> NDArray[np.float64]:
    """Linear colour (N, 3) of the surface."""
    tone = rng.uniform(0, 1)
    skin = (1 - tone) * np.array([0.72, 0.45, 0.33]) + tone * np.array([0.16, 0.08, 0.05])
    hair = rng.uniform(0.01, 0.12) * np.array([1.0, 0.75, 0.55])
    colour = np.broadcast_to(skin, (len(place.on_eyeball), 3)).copy()
    _blend(colour, skin * [0.85, 0.55, 0.55], place.of(place.subject.masks["lips"]))
    _blend(colour, np.array([0.05, 0.015, 0.015]), place.of(place.subject.masks["inside"]))
    _blend(colour, hair, place.of(place.subject.masks["scalp"]) > 0.5)
    rest = place.of(place.subject.rest)
    for eye in place.subject.eyes:
        _blend(colour, hair, 0.8 * (_on_brow(rest, eye) & ~place.on_eyeball))
        _paint_eyeball(colour, rest, eye, place.on_eyeball, rng)
    return colour


def _blend(colour: NDArray[np.float64], other: NDArray[np.float64], amount: NDArray) -> None:
    colour += (other - colour) * np.asarray(amount, float)[:, None]


def _on_brow(rest: NDArray[np.float64], eye: NDArray[np.float64]) -> NDArray[np.bool_]:
    outward = (rest[:, 0] - eye[0]) * np.sign(eye[0])
    rise = rest[:, 1] - eye[1] + 0.12 * np.abs(outward - 0.01)
    beside = (outward > -BROW_REACH_M[0]) & (outward < BROW_REACH_M[1])
    return beside & (rise > BROW_RISE_M[0]) & (rise < BROW_RISE_M[1]) & (rest[:, 2] > 0)


def _paint_eyeball(
    colour: NDArray[np.float64],
    rest: NDArray[np.float64],
    eye: NDArray[np.float64],
    on_eyeball: NDArray[np.bool_],
    rng: np.random.Generator,
) -> None:
    radius = np.hypot(rest[:, 0] - eye[0], rest[:, 1] - eye[1])
    here = on_eyeball & (np.sign(rest[:, 0]) == np.sign(eye[0]))
    colour[here] = [0.75, 0.72, 0.7]
    colour[here & (radius < IRIS_RADIUS_M)] = rng.uniform(0.02, 0.2) * np.array([1.0, 0.8, 0.6])
    colour[here & (radius < PUPIL_RADIUS_M)] = 0.01


def _lit(
    turned: NDArray[np.float64], triangles: NDArray[np.int64], place: _Place, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Light (N,) from a random side and all around."""
    a, b, c = (turned[triangles[:, k]] for k in range(3))
    face_normals = np.cross(b - a, c - a)
    normals = np.zeros_like(turned)
    for k in range(3):
        np.add.at(normals, triangles[:, k], face_normals)
    normals = place.of(normals)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True).clip(min=1e-12)
    light = np.array([rng.uniform(-0.8, 0.8), rng.uniform(-0.2, 0.8), 1.0])
    ambient = rng.uniform(0.25, 0.6)
    return ambient + (1.1 - ambient) * np.clip(normals @ (light / np.linalg.norm(light)), 0, 1)
