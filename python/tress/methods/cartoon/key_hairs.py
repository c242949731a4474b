"""Key hairs along the isocurves of a surface."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.kernel import nurbs
from tress.kernel.nurbs import Patch
from tress.methods.cartoon.params import KeyHairParams

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class KeyHairs:
    """`points` (n, p, 3) float64 metres, roots first, and the surface's unit `normals` (n, p, 3) there."""

    points: Array
    normals: Array


def key_hairs(surface: Patch, *, params: KeyHairParams = KeyHairParams(), lengths: Array | float = 1.0) -> KeyHairs:
    """n hairs of p control points, evenly spread over the surface's parameters; taken anew for every moment of an
    animated surface, they follow it exactly.

    A jitter moves hairs along v by up to half their spacing times it, never off the surface, and by the same parts at
    every moment. `lengths` (n,) are parts of the length that single hairs have. A length of 0 leaves a thousandth: a
    hair has a direction. Source: Modelling and Animating Cartoon Hair, section 3: vIncr = (vMax - vMin) / (n - 1),
    uIncr = (uMax - uMin) / (p - 1), CP_v(u) = S(u, v).

    >>> square = nurbs.patch([[[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0]]], degree_u=1, degree_v=1)
    >>> found = key_hairs(square, params=KeyHairParams(hairs=3, points=5, length=0.5))
    >>> found.points[1, -1].tolist(), found.normals[0, 0].tolist()
    ([0.5, 0.5, 0.0], [0.0, 0.0, -1.0])
    """
    surface = surface if params.along == "u" else surface.transposed()
    (low, high), (left, right) = surface.domain_u, surface.domain_v
    share = np.maximum(params.length * np.broadcast_to(lengths, params.hairs), 1e-3)
    part = np.linspace(0, 1, params.points) * share[:, None]
    along = low + (high - low) * (part if params.root == "first" else 1 - part)
    across = left + (right - left) * _places(params)
    uv = np.stack(np.broadcast_arrays(along, across[:, None]), axis=-1).reshape(-1, 2)
    shape = (params.hairs, params.points, 3)
    turned = (params.along == "v") != (params.side == "back")
    normals = nurbs.normals(surface, uv=uv) * (-1 if turned else 1)
    return KeyHairs(nurbs.evaluate(surface, uv=uv).reshape(shape), normals.reshape(shape))


def _places(params: KeyHairParams) -> Array:
    """(n,) places across the surface in [0, 1]."""
    even = np.linspace(0, 1, params.hairs)
    shift = np.random.default_rng(params.seed).uniform(-0.5, 0.5, params.hairs) * params.jitter / (params.hairs - 1)
    return np.clip(even + shift, 0, 1)
