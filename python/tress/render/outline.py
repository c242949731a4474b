"""Lines of even width where a drawing has them: silhouettes, creases, and borders of parts that stand apart.

Pixels of a picture finer than the one wanted are compared with their neighbours to the right and below. Between two of
them is a line where only one is filled; where a step in depth divides them, measured square to their surfaces, so that
a surface seen edge-on makes none; where normals turn sharply; and where meshes of different colours meet. Clumps that
lie on one another with less of a step meld. Lines of less than a few pixels are left out, and the others are as wide as
asked everywhere, since width is the distance to the nearest place of a line.

Source: Saito and Takahashi, Comprehensible Rendering of 3-D Shapes (1990): edges from geometric buffers.
"""

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from tress.base.params import Params, param
from tress.render.gbuffer import GBuffer, rasterise
from tress.render.seen_surface import SeenSurface, seen_surface

Array = np.ndarray[Any, Any]

_OTHER_COLOR = 0.25
"""Two colours whose difference is this part of the brighter one are not the same."""
_EDGE_ON = 0.25
"""Cosine to the viewer below which flat triangles say nothing of creases."""


@dataclass(frozen=True)
class OutlineParams(Params):
    """Where lines are, and how they look."""

    width_px: float = param(1.6, low=0, high=32, unit="px", doc="Width of the lines; 0 is none.")
    step_m: float = param(0.006, low=0, high=10, unit="m", doc="Clumps with a smaller step between them meld.")
    crease_rad: float = param(1.2, low=0, high=3.15, unit="rad", doc="A surface that turns more makes a line.")
    ink: float = param(0.18, low=0, high=1, doc="Brightness of lines, as a part of the colour beside them.")
    least_px: float = param(20.0, low=0, high=1000, unit="px", doc="Shorter lines are left out.")


def outlines(gbuffer: GBuffer, *, params: OutlineParams) -> Array:
    """(H, W, 4) float32 linear, premultiplied: the lines of a scene and nothing else.

    Cost: one more rasterisation at two or three times the resolution, and some passes over its pixels.
    """
    height, width = gbuffer.shape
    if params.width_px == 0 or len(gbuffer.fragments.weight) == 0:
        return np.zeros((height, width, 4), np.float32)
    finer = 2 if params.width_px >= 1.5 else 3
    matrix = np.diag([finer, finer, 1.0]) @ gbuffer.xy_from_world
    fine = rasterise(gbuffer.scene, xy_from_world=matrix, width=width * finer, height=height * finer)
    surface = seen_surface(fine)
    marked = line_pixels(surface, shape=fine.shape, away=fine.away, params=params)
    marked = without_short(marked, least_px=params.least_px * finer)
    return _inked(marked, surface.color.reshape(*fine.shape, 3), params, finer)


def line_pixels(surface: SeenSurface, *, shape: tuple[int, int], away: Array, params: OutlineParams) -> Array:
    """(H, W) bool: pixels beside which a line runs, on the nearer side of it."""
    numbers = np.arange(shape[0] * shape[1]).reshape(shape)
    marked = np.zeros(shape[0] * shape[1], bool)
    for first, second in ((numbers[:, :-1], numbers[:, 1:]), (numbers[:-1], numbers[1:])):
        a, b = _different(surface, first.ravel(), second.ravel())
        line = _is_line(surface, a, b, away, params)
        a, b = a[line], b[line]
        depth_a, depth_b = (np.where(surface.mesh[i] == -1, np.inf, surface.position[i] @ away) for i in (a, b))
        marked[np.where(depth_a <= depth_b, a, b)] = True
    return marked.reshape(shape)


def without_short(marked: Array, *, least_px: float) -> Array:
    """The lines (H, W) that reach at least so far across or down."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(marked.astype(np.uint8), connectivity=8)
    reach = np.maximum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT])
    kept = reach >= least_px
    kept[0] = False
    return kept[np.asarray(labels, np.int64)]


def _different(surface: SeenSurface, a: Array, b: Array) -> tuple[Array, Array]:
    """The pairs that show different triangles: only between those are lines."""
    other = (surface.triangle[a] != surface.triangle[b]) | (surface.mesh[a] != surface.mesh[b])
    return a[other], b[other]


def _is_line(surface: SeenSurface, a: Array, b: Array, away: Array, params: OutlineParams) -> Array:
    mesh_a, mesh_b = surface.mesh[a], surface.mesh[b]
    silhouette = (mesh_a == -1) != (mesh_b == -1)
    strands = (mesh_a < -1) & (mesh_b < -1)
    between = surface.position[b] - surface.position[a]
    step = np.maximum(_along(between, surface.normal[a]), _along(between, surface.normal[b]))
    same_mesh = mesh_a == mesh_b
    same = same_mesh & (surface.strip[a] == surface.strip[b])
    turned = np.einsum("kd,kd->k", surface.normal[a], surface.normal[b]) < np.cos(params.crease_rad)
    sharp = np.einsum("kd,kd->k", surface.face[a], surface.face[b]) < np.cos(params.crease_rad)
    seen = np.minimum(-surface.face[a] @ away, -surface.face[b] @ away) > _EDGE_ON
    apart = (step > params.step_m) | np.where(same, sharp & seen, turned)
    return silhouette | (~strands & (apart | (~same_mesh & _other_color(surface, a, b))))


def _along(vectors: Array, normals: Array) -> Array:
    return np.abs(np.einsum("kd,kd->k", vectors, normals))


def _other_color(surface: SeenSurface, a: Array, b: Array) -> Array:
    one, two = surface.color[a], surface.color[b]
    return np.abs(one - two).max(axis=1) > _OTHER_COLOR * np.maximum(one, two).max(axis=1)


def _inked(marked: Array, color: Array, params: OutlineParams, finer: int) -> Array:
    """Lines about the marked pixels, as wide as asked, in the size of the picture."""
    height, width = marked.shape
    if not marked.any():
        return np.zeros((height // finer, width // finer, 4), np.float32)
    distance, nearest = cv2.distanceTransformWithLabels(
        (~marked).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_5, labelType=cv2.DIST_LABEL_PIXEL
    )
    nearest = nearest.astype(np.int64)
    cover = np.clip(0.5 * params.width_px * finer + 0.5 - distance, 0, 1).astype(np.float32)
    ink = np.zeros((int(nearest.max()) + 1, 3), np.float32)
    ink[nearest[marked]] = params.ink * color[marked]
    drawn = np.zeros((height, width, 4), np.float32)
    on = cover > 0
    drawn[on, :3] = ink[nearest[on]] * cover[on, None]
    drawn[..., 3] = cover
    return cv2.resize(drawn, (width // finer, height // finer), interpolation=cv2.INTER_AREA)
