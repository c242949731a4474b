"""Strands as thin flat ribbons, for viewers that draw triangles only.

A ribbon lies flat on the hair: its face looks away from the head. A roll about its own axis, different for each
strand, keeps some of them broad from every side, so that the silhouette does not thin out. Where only a subset is
shown, the ribbons are widened by what is missing, so that the hair covers as much as before. Opacity narrows a ribbon
instead of making it transparent, which viewers cannot sort.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.params import Params, param
from tress.model.strands import Strands

Array = np.ndarray[Any, Any]

DEFAULT_RADIUS_M = 4e-5
GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))


@dataclass(frozen=True)
class RibbonParams(Params):
    """How many ribbons, how fine, how wide."""

    strands: int = param(16_000, low=1, high=1_000_000, doc="At most so many strands are shown, drawn by seed.")
    points: int = param(16, low=2, high=1_000, doc="At most so many points a strand.")
    width: float = param(1.3, low=0.01, high=100.0, doc="Factor on all widths.")
    max_width_m: float = param(1.2e-3, low=1e-6, high=1.0, unit="m", doc="No ribbon is wider than this.")
    roll: float = param(0.9, low=0.0, high=np.pi, unit="rad", doc="Ribbons turn about their axis by up to this.")
    seed: int = param(0, low=0, high=2**31 - 1, doc="Draws the strands that are shown.")


@dataclass(frozen=True)
class Ribbons:
    """Triangles: `positions` (V, 3) float32 metres, `color` (V, 3) float32 linear, `normals`, `triangles` (F, 3)."""

    positions: Array
    normals: Array
    color: Array
    triangles: Array


def thinned(strands: Strands, *, strands_at_most: int, points_at_most: int, seed: int) -> Strands:
    """A seeded subset of the strands, in their order, each with at most `points_at_most` points evenly along it.

    Point attributes are interpolated, and kept if they are floats; strand attributes are dropped.
    """
    order = np.random.default_rng(seed).permutation(strands.count)[:strands_at_most]
    chosen = np.sort(order)
    old, first = strands.lengths[chosen], strands.offsets[:-1][chosen]
    new = np.minimum(old, points_at_most)
    offsets = np.concatenate([np.zeros(1, np.int64), np.cumsum(new)])
    strand = np.repeat(np.arange(len(chosen)), new)
    along = (np.arange(offsets[-1]) - offsets[:-1][strand]) / (new - 1)[strand] * (old - 1)[strand]
    low = np.minimum(along.astype(np.int64), old[strand] - 2)
    place, fraction = first[strand] + low, (along - low).astype(np.float32)
    sampled = {name: values for name, values in strands.point_attributes.items() if values.dtype.kind == "f"}
    return Strands(
        points=_between(strands.points, place, fraction),
        offsets=offsets,
        point_attributes={name: _between(values, place, fraction) for name, values in sampled.items()},
    )


def ribbons(strands: Strands, *, params: RibbonParams) -> Ribbons:
    """The ribbons of strands that lie about a head whose centre is the origin, Y up."""
    shown = thinned(strands, strands_at_most=params.strands, points_at_most=params.points, seed=params.seed)
    strand = np.repeat(np.arange(shown.count), shown.lengths)
    points = shown.points.astype(np.float64)
    tangents = _tangents(points, shown.offsets)
    across = _unit(np.cross(tangents, _outward(points)), fallback=(1.0, 0.0, 0.0))
    roll = params.roll * (2 * ((strand * GOLDEN_ANGLE / (2 * np.pi)) % 1.0) - 1)[:, None]
    face = np.cross(across, tangents)
    side = np.cos(roll) * across + np.sin(roll) * face
    half = _widths(shown, strands.count, params)[:, None] / 2 * side
    color = shown.point_attributes.get("color", np.full((len(points), 3), 0.2, np.float32))
    return Ribbons(
        positions=_interleaved(points - half, points + half),
        normals=_interleaved(*[_unit(np.cross(side, tangents), fallback=(0.0, 0.0, 1.0))] * 2),
        color=_interleaved(color, color),
        triangles=_triangles(shown.offsets),
    )


def _widths(shown: Strands, total: int, params: RibbonParams) -> Array:
    radius = shown.point_attributes.get("radius", np.full(len(shown.points), DEFAULT_RADIUS_M, np.float32))
    alpha = np.clip(shown.point_attributes.get("alpha", np.ones(len(shown.points), np.float32)), 0, 1)
    missing = total / max(shown.count, 1)
    return np.minimum(2 * radius * params.width * missing, params.max_width_m) * alpha


def _outward(points: Array) -> Array:
    """Away from the head's centre, and below it away from the neck's axis."""
    axis = points.copy()
    axis[:, 1] = np.maximum(points[:, 1], 0)
    return axis


def _tangents(points: Array, offsets: Array) -> Array:
    """Unit tangents: central differences, one-sided at the ends of each strand."""
    after, before = np.arange(1, len(points) + 1), np.arange(-1, len(points) - 1)
    after[offsets[1:] - 1] -= 1
    before[offsets[:-1]] += 1
    return _unit(points[after] - points[before], fallback=(0.0, -1.0, 0.0))


def _unit(vectors: Array, *, fallback: tuple[float, float, float]) -> Array:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(length > 1e-12, vectors / np.maximum(length, 1e-12), fallback)


def _triangles(offsets: Array) -> Array:
    inner = np.ones(offsets[-1], bool)
    inner[offsets[1:] - 1] = False
    left = 2 * np.flatnonzero(inner).astype(np.uint32)[:, None]
    return (left + np.array([[0, 1, 3, 0, 3, 2]], np.uint32)).reshape(-1, 3)


def _interleaved(left: Array, right: Array) -> Array:
    return np.stack([left, right], axis=1).reshape(-1, 3).astype(np.float32)


def _between(values: Array, place: Array, fraction: Array) -> Array:
    weight = fraction.reshape(-1, *[1] * (values.ndim - 1))
    return values[place] * (1 - weight) + values[place + 1] * weight
