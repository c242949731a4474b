"""Surfaces laid over a head: curves side by side, each an array of points, and the patch through them.

Curves are (V, K, 3): V side by side, K points from root to tip. A preset makes them of a few calls and hands them to
`sheet`.
"""

from typing import Any

import numpy as np

from tress.kernel import nurbs
from tress.kernel.nurbs import Patch
from tress.methods.cartoon.skull import Skull

Array = np.ndarray[Any, Any]

FINE = 96
"""Points of a curve."""


def sheet(curves: Array, *, rows: int = 10) -> Patch:
    """The surface nearest to curves (V, K, 3), u along them from root to tip, evenly by their length."""
    even = by_length(curves, count=4 * rows)
    u, v = np.meshgrid(np.linspace(0, 1, 4 * rows), np.linspace(0, 1, len(even)), indexing="ij")
    columns = min(len(even), max(4, 2 * len(even) // 3))
    return nurbs.fit(
        even.swapaxes(0, 1).reshape(-1, 3),
        uv=np.stack([u, v], axis=-1).reshape(-1, 2),
        counts=(rows, columns),
        degrees=(3, min(3, columns - 1)),
        smoothness=1e-4,
    )


def over_head(
    skull: Skull, *, azimuth: Array, start: float, length_m: Any, lift_m: float, flare: float = 0.0, turn: float = 0.0
) -> Array:
    """Hair that runs from the polar angle `start` (radians) of the whorl down over the head at every azimuth (V,), and
    hangs from where it is farthest out.

    `lift_m` above the head; `flare`, how far it goes outwards as it hangs, a metre down; `turn`, radians that it goes
    about the head on the way down; `length_m`, one or (V,).
    """
    polar = np.linspace(start, 0.9 * np.pi, FINE)
    about = azimuth[:, None] + turn * (polar - start) / np.pi
    points = skull.points(about, polar)
    middle = np.array([0, 0, -0.02])
    outwards = points - middle
    outwards /= np.linalg.norm(outwards, axis=-1, keepdims=True)
    grown = np.clip(0.7 + polar, 0, 1)[:, None]
    points = points + lift_m * grown * outwards
    level = np.stack([np.sin(about), 0 * about, np.cos(about)], axis=-1)
    leaves = np.maximum(np.argmax(np.einsum("vki,vki->vk", points, level), axis=1), 2)
    reach = np.broadcast_to(length_m, len(points))
    return np.stack([_hung(*each, flare) for each in zip(points, leaves, reach, strict=True)])


def _hung(points: Array, leaves: int, length_m: float, flare: float) -> Array:
    """(FINE, 3): one curve, from point `leaves` on straight down."""
    edge = points[leaves]
    level = edge * [1, 0, 1]
    away = level / max(np.linalg.norm(level), 1e-9)
    ahead = points[leaves] - points[leaves - 1]
    ahead /= np.linalg.norm(ahead)
    way = np.array([0, -1, 0]) + flare * away
    way /= np.linalg.norm(way)
    s = np.linspace(0, length_m, FINE)[1:]
    bent = np.minimum(s / 0.05, 1)[:, None]
    steps = (1 - bent) * ahead + bent * way
    hanging = edge + np.cumsum(steps * np.diff(s, prepend=0)[:, None], axis=0)
    return cut(np.concatenate([points[: leaves + 1], hanging])[None], length_m=length_m)[0]


def by_length(curves: Array, *, count: int) -> Array:
    """(V, count, 3) points at even lengths."""
    return cut(curves, length_m=np.inf, count=count)


def cut(curves: Array, *, length_m: Any, count: int = FINE) -> Array:
    """(V, count, 3) points at even lengths of curves cut off at `length_m`, one or (V,), where they are longer."""
    reach = np.broadcast_to(length_m, len(curves))
    return np.stack([_cut(curve, float(most), count) for curve, most in zip(curves, reach, strict=True)])


def _cut(curve: Array, most: float, count: int) -> Array:
    way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    stops = np.linspace(0, min(most, way[-1]), count)
    return np.column_stack([np.interp(stops, way, curve[:, axis]) for axis in range(3)])


def length_to(curves: Array, *, height_m: Any) -> Array:
    """(V,) length of curves down to a height, one or (V,), or their whole length."""
    level = np.broadcast_to(height_m, len(curves))
    way = np.concatenate([np.zeros((len(curves), 1)), np.cumsum(np.linalg.norm(np.diff(curves, axis=1), axis=2), 1)], 1)
    below = curves[:, :, 1] < level[:, None]
    return np.where(below.any(axis=1), way[np.arange(len(curves)), np.argmax(below, axis=1)], way[:, -1])


def bent(curves: Array, *, towards: Any, power: float = 2.0, begins: float = 0.0) -> Array:
    """Curves whose tips are moved by `towards` ((3,) or (V, 3), metres), points before them by a power of their part of
    the length after `begins`."""
    part = np.clip((np.linspace(0, 1, curves.shape[1]) - begins) / (1 - begins), 0, 1) ** power
    way = np.broadcast_to(np.asarray(towards, float), (len(curves), 3))
    return curves + part[:, None] * way[:, None]


def outwards(curves: Array) -> Array:
    """(V, 3) level unit vectors away from the middle of the head at the tips."""
    level = curves[:, -1] * [1, 0, 1] - [0, 0, -0.015]
    return level / np.linalg.norm(level, axis=1, keepdims=True)


def bezier(control: Array) -> Array:
    """(V, FINE, 3) points of Bézier curves with control points (V, Q, 3)."""
    points, t = control[:, None], np.linspace(0, 1, FINE)[:, None, None]
    while points.shape[2] > 1:
        points = (1 - t) * points[:, :, :-1] + t * points[:, :, 1:]
    return points[:, :, 0]


def mirrored(curves: Array) -> Array:
    """The curves on the other side of the head, in an order that keeps their normals outwards."""
    return (curves * [-1, 1, 1])[::-1]


def swept_to(skull: Skull, *, tie: Any, azimuth: Array, lift_m: float, end: float = 0.1, edge: Any = None) -> Array:
    """Hair that lies on the head from the hairline, or from polar angles `edge` (V,), to a tie in direction (3,)."""
    begin = _calm(skull.hairline(azimuth, pole=tie) if edge is None else edge)
    polar = begin[:, None] + (end - begin[:, None]) * np.linspace(0, 1, FINE)
    points = skull.points(azimuth[:, None], polar, pole=tie)
    return points + lift_m * points / np.linalg.norm(points, axis=-1, keepdims=True)


def _calm(angles: Array) -> Array:
    """(V,) without jumps: where ears cut into a hairline, say."""
    padded = np.pad(angles, 2, mode="edge")
    middle = np.median([padded[shift : len(padded) - 4 + shift] for shift in range(5)], axis=0)
    padded = np.pad(middle, 1, mode="edge")
    return (padded[:-2] + 2 * middle + padded[2:]) / 4


def tube(axis: Array, *, radius_m: Array, hairs: int) -> Array:
    """(hairs, K, 3) curves evenly round an axis (K, 3) at radii (K,); normals outwards."""
    along = np.gradient(axis, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    side = np.empty_like(axis)
    side[0] = np.cross(along[0], np.eye(3)[np.argmin(np.abs(along[0]))])
    for index in range(1, len(side)):
        side[index] = side[index - 1] - (side[index - 1] @ along[index]) * along[index]
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    angle = 2 * np.pi * np.arange(hairs)[:, None, None] / hairs
    return axis + radius_m[:, None] * (np.cos(angle) * side + np.sin(angle) * np.cross(along, side))
