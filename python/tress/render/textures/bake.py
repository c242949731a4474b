"""One card of strands seen from straight above, as pictures.

The strand rasteriser sees the card in pixels of twice the resolution, 16 samples each, so that a texel has 64; every
fragment is shaded by its place along and across its strand, and texels are the means of what they see.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.kernel import raster
from tress.render.textures.card_strands import HALF_DEPTH, CardStrands

Array = np.ndarray[Any, Any]

FINER = 2
"""Pixels of the rasteriser along the side of a texel."""
ROUNDNESS = 0.85
"""Sine of the steepest angle that a strand's normal has at its edge: a full 1 would leave only noise at this size."""
_EDGE_SHADE = 0.22
"""How much darker the colour is at the edge of a strand."""
_IDS, _ID_STEP = 255, 157
"""The step has no factor in common with the number of ids and is near its golden section."""


@dataclass(frozen=True, eq=False)
class BakedCard:
    """Means over texels, weighted by what is seen: `coverage` (H, W), and straight values where it is above 0, else 0.

    `color` (H, W, 3) linear; `normal` and `flow` (H, W, 3): x right, y UP, z towards the viewer, not normalised;
    `root_to_tip` and `depth` (H, W) in [0, 1], 1 near; `strand_id` (H, W) uint8, 1 to 255, of the strand that fills
    most, else 0.
    """

    coverage: Array
    color: Array
    normal: Array
    flow: Array
    root_to_tip: Array
    depth: Array
    strand_id: Array


@dataclass(frozen=True, eq=False)
class _Seen:
    """The fragments, with their strand (F,) and a way to interpolate values of the strands' points."""

    fragments: raster.Fragments
    first: Array
    strand: Array

    @property
    def t(self) -> Array:
        return self.fragments.parameter[:, :1]

    @property
    def across(self) -> Array:
        return self.fragments.parameter[:, 1]

    def values(self, per_point: Array) -> Array:
        """(F, C) float32 of values (S, P, C)."""
        flat = per_point.reshape(-1, per_point.shape[-1]).astype(np.float32)
        return flat[self.first] * (1 - self.t) + flat[self.first + 1] * self.t

    def texel_means(self, values: Array) -> Array:
        """(H, W, 4) float32 at the texture's resolution: sums of weight times three values (F, 3), and of weight."""
        rgba = np.concatenate([values, np.ones_like(self.t)], axis=1)
        fine = raster.composite(self.fragments, rgba=np.ascontiguousarray(rgba, np.float32))
        offsets = [(row, column) for row in range(FINER) for column in range(FINER)]
        return np.sum([fine[row::FINER, column::FINER] for row, column in offsets], axis=0) / np.float32(FINER**2)


def bake_card(strands: CardStrands, colors: Array, *, width: int, height: int) -> BakedCard:
    """Pictures of `width` x `height` texels of a card with the `colors` (S, P, 3), linear, of its strands' points."""
    seen = _seen(strands, width, height)
    tangent = _unit(np.gradient(strands.points, axis=1))
    color = seen.texel_means(_shaded(seen, colors))
    along = np.stack([strands.t, strands.points[..., 2], strands.roll], axis=-1)
    values = seen.values(along)
    direction = _unit(seen.values(tangent)) * np.array([1, -1, 1], np.float32)
    normal = _normals(direction, values[:, 2] + np.arcsin(ROUNDNESS * seen.across))
    depth = 0.5 + 0.5 * values[:, 1] / HALF_DEPTH
    plain = _means(seen.texel_means(np.stack([values[:, 0], depth, depth], axis=1)))
    return BakedCard(
        coverage=color[..., 3],
        color=_means(color),
        normal=_means(seen.texel_means(normal)),
        flow=_means(seen.texel_means(direction)),
        root_to_tip=plain[..., 0],
        depth=plain[..., 1],
        strand_id=_heaviest(seen, strand_ids(len(strands.points))),
    )


def strand_ids(count: int) -> Array:
    """(count,) uint8 from 1 to 255: neighbours differ much; beyond 255 strands some share a number."""
    return (1 + np.arange(count) * _ID_STEP % _IDS).astype(np.uint8)


def _seen(strands: CardStrands, width: int, height: int) -> _Seen:
    count, points = strands.t.shape
    px = width * FINER
    projected = np.concatenate(
        [strands.points[..., :2] * px, -strands.points[..., 2:], np.ones((count, points, 1))], axis=-1
    )
    fragments = raster.rasterise(
        projected.reshape(-1, 4),
        offsets=np.arange(count + 1) * points,
        half_width_px=(strands.half_width * px).reshape(-1),
        alpha=strands.opacity.reshape(-1),
        mesh_vertices=np.zeros((0, 4)),
        triangles=np.zeros((0, 3), np.uint32),
        width=width * FINER,
        height=height * FINER,
    )
    return _Seen(fragments, fragments.primitive, fragments.primitive // points)


def _shaded(seen: _Seen, colors: Array) -> Array:
    """A little darker towards the edges of every strand, so that strands stay apart where they lie side by side."""
    return seen.values(colors) * (1 - _EDGE_SHADE * seen.across**2)[:, None]


def _normals(direction: Array, angle: Array) -> Array:
    """Unit normals (F, 3): the upward one turned about the strand by `angle`, positive to the strand's right side.

    With y up, the right side of the direction d is d x z.
    """
    up = np.array([0, 0, 1], np.float32)
    side = _unit(np.cross(direction, up))
    above = np.cross(side, direction)
    return side * np.sin(angle)[:, None] + above * np.cos(angle)[:, None]


def _means(sums: Array) -> Array:
    """(H, W, 3): the sums over their weight, 0 where there is none."""
    weight = sums[..., 3:]
    return np.divide(sums[..., :3], weight, out=np.zeros_like(sums[..., :3]), where=weight > 0)


def _heaviest(seen: _Seen, ids: Array) -> Array:
    """(H, W) uint8: the id of the strand with the largest fragment in every texel, 0 where there is none.

    The weight in sixteenths is written in front of the strand's number, so that the largest word decides.
    """
    fragments = seen.fragments
    words = (np.rint(fragments.weight * 16).astype(np.int64) << 32) | (seen.strand + 1)
    heaviest = np.zeros(fragments.width * fragments.height, np.int64)
    filled = np.flatnonzero(np.diff(fragments.pixel_offsets))
    if len(filled):
        heaviest[filled] = np.maximum.reduceat(words, fragments.pixel_offsets[filled])
    rows, columns = fragments.height // FINER, fragments.width // FINER
    of_texel = heaviest.reshape(rows, FINER, columns, FINER).max(axis=(1, 3)) & 0xFFFFFFFF
    return np.concatenate([np.zeros(1, np.uint8), ids])[of_texel]


def _unit(vectors: Array) -> Array:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.maximum(length, 1e-12)
