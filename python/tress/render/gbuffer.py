"""Visibility: which strands and triangles every pixel sees. Made once; styles shade it."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.kernel import raster
from tress.render.flat_scene import FlatScene

Array = np.ndarray[Any, Any]

SAMPLES = 16


@dataclass(frozen=True, eq=False)
class GBuffer:
    """Fragments of a scene seen by a camera; see `tress.kernel.raster.Fragments` for the arrays."""

    scene: FlatScene
    xy_from_world: Array
    fragments: raster.Fragments

    @property
    def shape(self) -> tuple[int, int]:
        """(height, width) in pixels."""
        return self.fragments.height, self.fragments.width

    @property
    def away(self) -> Array:
        """(3,) float64: unit vector in the world that points away from the camera, along its axis."""
        rows = np.asarray(self.xy_from_world, np.float64)[:, :3]
        axis = rows[2] if np.linalg.norm(rows[2]) > 1e-9 * np.linalg.norm(rows[0]) else np.cross(rows[0], rows[1])
        return axis / np.linalg.norm(axis)


@dataclass(frozen=True, eq=False)
class HairFragments:
    """The K fragments that show strands: `index` (K,) into all, their segment's `first` point (K,), and `t` (K,)."""

    index: Array
    first: Array
    t: Array

    def values(self, per_point: Array) -> Array:
        """(K, ...) float32: values (N, ...) of the points, interpolated along the segments."""
        t = self.t.reshape(-1, *(1,) * (per_point.ndim - 1))
        return per_point[self.first] * (1 - t) + per_point[self.first + 1] * t


def rasterise(
    scene: FlatScene,
    *,
    xy_from_world: Array,
    width: int,
    height: int,
    samples: int = SAMPLES,
    strand_bias_m: float = 0.0,
    min_width_px: float = 1.0,
) -> GBuffer:
    """What a camera (3, 4), affine or perspective, sees of the scene.

    `strand_bias_m` moves strands towards the camera in the depth test only, so that roots do not fight with the skin.
    Raises `InputError` for a number of samples other than 16 and for pictures without pixels.
    """
    if samples != SAMPLES:
        raise InputError(f"samples is {samples}; {SAMPLES} was expected, the only pattern there is.")
    points = raster.project(scene.points, xy_from_points=xy_from_world)
    fragments = raster.rasterise(
        _nearer(points, strand_bias_m, xy_from_world),
        offsets=scene.offsets,
        half_width_px=scene.radius * points[:, 3],
        alpha=scene.alpha,
        mesh_vertices=raster.project(scene.positions, xy_from_points=xy_from_world),
        triangles=scene.triangles,
        width=width,
        height=height,
        min_width_px=min_width_px,
    )
    return GBuffer(scene=scene, xy_from_world=np.asarray(xy_from_world, np.float64), fragments=fragments)


def hair_fragments(gbuffer: GBuffer) -> HairFragments:
    """The fragments that show strands."""
    index = np.flatnonzero(gbuffer.fragments.kind == raster.SEGMENT)
    return HairFragments(index, gbuffer.fragments.primitive[index], gbuffer.fragments.parameter[index, 0])


def hair_coverage(gbuffer: GBuffer) -> Array:
    """(H, W) float32: the share of every pixel in which a strand is seen."""
    fragments = gbuffer.fragments
    rgba = np.zeros((len(fragments.weight), 4), np.float32)
    rgba[:, 3] = fragments.kind == raster.SEGMENT
    return raster.composite(fragments, rgba=rgba)[..., 3]


def visible_weight(gbuffer: GBuffer) -> Array:
    """(N,) float32: how many pixels every point of the strands fills in the picture."""
    return raster.visible_weight(gbuffer.fragments, points=len(gbuffer.scene.points))


def _nearer(points: Array, bias_m: float, xy_from_world: Array) -> Array:
    if bias_m == 0:
        return points
    moved = points.copy()
    if np.linalg.norm(np.asarray(xy_from_world)[2, :3]) > 0:
        moved[:, 2] = points[:, 2] / (1 + points[:, 2] * bias_m)
    else:
        moved[:, 2] -= bias_m
    return moved
