"""Textured, alpha-tested cards as a cloud of points: a picture of hair as a game shows it, on any processor.

Points lie evenly on the triangles, each takes its texel, those that fail the alpha test are dropped, and the nearest
point of a pixel wins. Light plays no part: what is compared in this way is coverage and colour.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.color import srgb_to_linear
from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]

SKIN = (0.35, 0.22, 0.17)
PER_SAMPLE = 1.5
PORTION = 1 << 16
"""Points made at once."""
DEPTH_STEP_M = 1e-5
NOTHING = np.iinfo(np.int64).max
FIRST, SECOND = 0.7548776662466927, 0.5698402909980532
"""Steps of the plastic sequence (Roberts 2018): points that fill a square evenly, however many there are."""


@dataclass(frozen=True, eq=False)
class CardPoints:
    """`positions` (P, 3) float32, linear `color` (P, 3) float32 and whether each is `hair` (P,)."""

    positions: Array
    color: Array
    hair: Array


@dataclass(frozen=True, eq=False)
class CardView:
    """`color` (H, W, 3) float32 linear, black where nothing is; `hair` and `filled` (H, W) float32, the shares of the
    pixel in which hair, and anything, is seen."""

    color: Array
    hair: Array
    filled: Array


def card_points(
    cards: Sequence[Mesh], others: Sequence[Mesh] = (), *, spacing_m: float, threshold: float = 0.5
) -> CardPoints:
    """Points of cards, their texture tested at `threshold`, and of other meshes in their vertex colours,
    or else in the colour of skin.

    There is a point for every `spacing_m`² of cards, and four of other surfaces.
    """
    parts = [_sampled(mesh, spacing_m, threshold, hair=True) for mesh in cards]
    parts += [_sampled(mesh, 0.5 * spacing_m, threshold, hair=False) for mesh in others]
    return CardPoints(
        positions=np.concatenate([np.zeros((0, 3), np.float32), *(part.positions for part in parts)]),
        color=np.concatenate([np.zeros((0, 3), np.float32), *(part.color for part in parts)]),
        hair=np.concatenate([np.zeros(0, bool), *(part.hair for part in parts)]),
    )


def card_view(points: CardPoints, *, xy_from_world: Array, width: int, height: int, samples: int = 2) -> CardView:
    """What an affine camera (3, 4) sees of the points, at `samples` x `samples` a pixel."""
    wide, high = width * samples, height * samples
    nearest = _nearest(points.positions, np.asarray(xy_from_world, np.float64), samples, wide, high)
    seen = nearest >= 0
    values = np.zeros((wide * high, 5), np.float32)
    values[seen, :3] = points.color[nearest[seen]]
    values[seen, 3] = points.hair[nearest[seen]]
    values[seen, 4] = 1
    mean = values.reshape(height, samples, width, samples, 5).mean(axis=(1, 3))
    return CardView(mean[..., :3], mean[..., 3], mean[..., 4])


def _nearest(positions: Array, rows: Array, samples: int, wide: int, high: int) -> Array:
    """(wide * high,) int64: the point seen in every sample of the picture, -1 for none."""
    away = np.cross(rows[0, :3], rows[1, :3])
    away /= np.linalg.norm(away)
    x, y = ((positions @ row[:3].astype(np.float32) + np.float32(row[3])) * samples for row in rows[:2])
    inside = np.flatnonzero((x >= 0) & (x < wide) & (y >= 0) & (y < high))
    place = y[inside].astype(np.int64) * wide + x[inside].astype(np.int64)
    # A millimetre is some hundred steps of depth; of points in one step the first wins, on any machine.
    depth = (positions[inside] @ away.astype(np.float32) / DEPTH_STEP_M).astype(np.int64) + 2**30
    best = np.full(wide * high, NOTHING)
    np.minimum.at(best, place, depth << 32 | inside)
    return np.where(best == NOTHING, -1, best & 0xFFFFFFFF)


def _sampled(mesh: Mesh, spacing_m: float, threshold: float, *, hair: bool) -> CardPoints:
    """Points of one mesh, made in portions that stay in the processor's caches."""
    corners = mesh.positions[mesh.triangles].astype(np.float32)
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    before = np.concatenate([[0.0], np.cumsum(area / spacing_m**2)])
    ends = np.floor(before + 0.5).astype(np.int64)
    textured = mesh.texture is not None and mesh.corner_uv is not None and hair
    linear = srgb_to_linear(mesh.texture.pixels[..., :3]).reshape(-1, 3) if textured and mesh.texture else None
    parts = []
    for start in range(0, int(ends[-1]), PORTION):
        number = np.arange(start, min(start + PORTION, int(ends[-1])))
        triangle = np.searchsorted(ends, number, side="right") - 1
        barycentric = _barycentric(number)
        if linear is None or mesh.texture is None or mesh.corner_uv is None:
            positions = _interpolated(corners, triangle, barycentric)
            color = _painted(mesh, triangle, barycentric)
        else:
            uv = _interpolated(mesh.corner_uv, triangle, barycentric)
            kept = np.flatnonzero(_tested(mesh.texture.pixels, uv, threshold))
            positions = _interpolated(corners, triangle[kept], barycentric[kept])
            color = _texels(linear, mesh.texture.pixels.shape, uv[kept])
        parts.append((positions, color))
    positions = np.concatenate([np.zeros((0, 3), np.float32), *(part for part, _ in parts)])
    color = np.concatenate([np.zeros((0, 3), np.float32), *(part for _, part in parts)])
    return CardPoints(positions, color, np.full(len(positions), hair))


def _painted(mesh: Mesh, triangle: Array, barycentric: Array) -> Array:
    """(P, 3) float32: the vertex colours of a mesh at points of its triangles, or skin where it has none."""
    color = mesh.vertex_attributes.get("color", np.zeros(0))
    if color.shape != mesh.positions.shape:
        return np.broadcast_to(np.array(SKIN, np.float32), (len(triangle), 3))
    return _interpolated(color[mesh.triangles].astype(np.float32), triangle, barycentric)


def _interpolated(corners: Array, triangle: Array, barycentric: Array) -> Array:
    """(P, D) float32 values (F, 3, D) of the corners at points of the triangles."""
    total = np.zeros((len(triangle), corners.shape[2]), np.float32)
    for corner in range(3):
        total += corners[triangle, corner] * barycentric[:, corner, None]
    return total


def _texels(linear: Array, shape: tuple[int, ...], uv: Array) -> Array:
    """(P, 3) float32 linear colours of the texels under the points, in a picture of that shape."""
    height, width = shape[:2]
    column = np.clip((uv[:, 0] * width).astype(np.int64), 0, width - 1)
    row = np.clip(((1 - uv[:, 1]) * height).astype(np.int64), 0, height - 1)
    return linear[row * width + column]


def _barycentric(number: Array) -> Array:
    """(P, 3) float32 coordinates of the points of that number; following ones fill a triangle evenly."""
    b, c = (0.5 + number * FIRST) % 1.0, (0.5 + number * SECOND) % 1.0
    b, c = np.where(b + c > 1, 1 - b, b), np.where(b + c > 1, 1 - c, c)
    return np.stack([1 - b - c, b, c], axis=1).astype(np.float32)


def _tested(pixels: Array, uv: Array, threshold: float) -> Array:
    """(P,) whether the bilinear alpha reaches the threshold."""
    if pixels.shape[2] == 3:
        return np.ones(len(uv), bool)
    height, width = pixels.shape[:2]
    alpha = np.ascontiguousarray(pixels[..., 3]).reshape(-1)
    x = np.clip(uv[:, 0] * width - np.float32(0.5), 0, width - 1)
    y = np.clip((1 - uv[:, 1]) * height - np.float32(0.5), 0, height - 1)
    column, row = x.astype(np.int32), y.astype(np.int32)
    fx, fy = x - column, y - row
    right = np.minimum(column + 1, width - 1) - column
    upper, lower = row * width + column, np.minimum(row + 1, height - 1) * width + column
    above = alpha[upper] * (1 - fx) + alpha[upper + right] * fx
    below = alpha[lower] * (1 - fx) + alpha[lower + right] * fx
    return above * (1 - fy) + below * fy >= 255 * threshold
