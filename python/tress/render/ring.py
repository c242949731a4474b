"""The bright ring on drawn hair: at the same part of every clump's length, or around the head where light is thrown
back."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.params import Params, choice, param
from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]

AWAY = 0.3
"""Cosine to the half vector at which the ring ends."""


@dataclass(frozen=True)
class RingParams(Params):
    """Where the ring lies and how it looks."""

    by: str = choice(
        "light",
        options=("light", "fraction", "none"),
        doc="Around the head where round hair throws light back, or at a part of each clump from root to tip.",
    )
    fraction: float = param(0.3, low=0, high=1, doc="Middle of the ring from root 0 to tip 1.")
    width: float = param(0.16, low=0, high=1, doc="Width, as a part of the length or as a sine.")
    tilt: float = param(0.0, low=-1, high=1, doc="How far a ring by light lies nearer to the tips.")
    teeth: float = param(0.6, low=0, high=1, doc="How far the ring narrows to the sides of every clump.")
    gleam: float = param(0.42, low=0, high=1, doc="How far the ring goes from the colour to white.")


def ring_by_fraction(fraction: Array, *, lens: Array, params: RingParams) -> Array:
    """(K,) above 0 within the ring, from the parts `fraction` (K,) of the length and `lens` (K,), see `lens_across`."""
    return _half_width(lens, params) - np.abs(fraction - params.fraction)


def ring_by_light(sine: Array, *, facing: Array, lens: Array, params: RingParams) -> Array:
    """(K,) above 0 within the ring, from the sine (K,) between the half vector and the plane across the hair.

    Its width goes to 0 where hair faces away from the light and the viewer: `facing` (K,) is the cosine to both.
    """
    return _half_width(lens, params) * np.minimum(2 * (facing - AWAY), 1) - np.abs(sine + params.tilt)


def body_along(body: Array) -> Array:
    """(V, 3) directions down over a round body with normals `body` (V, 3), as hair lies on a head."""
    down = body * body[:, 1:2] - np.array([0.0, 1.0, 0.0])
    return down / np.linalg.norm(down, axis=1, keepdims=True).clip(1e-6)


def lens_across(mesh: Mesh) -> Array:
    """(V,) angle whose sine is 0 at the sides of every strip and 1 in its middle; of a closed clump, of either face."""
    across = mesh.vertex_attributes["fraction"][:, 1].astype(np.float64)
    return np.pi * across * np.where(closed_strips(mesh)[mesh.vertex_attributes["strip"]], 2, 1)


def closed_strips(mesh: Mesh) -> Array:
    """(S,) bool by strip: whether its two sides are the same line, as those of a clump are."""
    strip, across = mesh.vertex_attributes["strip"], mesh.vertex_attributes["fraction"][:, 1]
    count = int(strip.max()) + 1 if len(strip) else 0
    left, right = (_means(mesh.positions[mine], strip[mine], count) for mine in (across == 0, across == 1))
    size = np.zeros(count)
    np.maximum.at(size, strip, np.linalg.norm(mesh.positions - left[strip], axis=1))
    return np.linalg.norm(left - right, axis=1) < 1e-4 * np.maximum(size, 1e-9)


def _means(points: Array, strip: Array, count: int) -> Array:
    sums = np.stack([np.bincount(strip, weights=points[:, axis], minlength=count) for axis in range(3)], axis=1)
    return sums / np.maximum(np.bincount(strip, minlength=count), 1)[:, None]


def _half_width(lens: Array, params: RingParams) -> Array:
    return 0.5 * params.width * (1 - params.teeth + params.teeth * np.abs(np.sin(lens)))
