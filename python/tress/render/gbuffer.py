"""Visibility: which strands and triangles every pixel sees. Made once; styles shade it."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.kernel import raster
from tress.render.flat_scene import FlatScene, strand_of_point

Array = np.ndarray[Any, Any]

SAMPLES = 16


@dataclass(frozen=True, eq=False)
class SceneOnScreen:
    """A scene as a camera sees it, ready to be rasterised, also more than once in other opacities.

    `points` (N, 4) and `vertices` (V, 4) float32 are the projected points of the strands and vertices of the meshes,
    `half_width_px` (N,) float32 that of the strands.
    """

    scene: FlatScene
    xy_from_world: Array
    width: int
    height: int
    points: Array
    vertices: Array
    half_width_px: Array
    min_width_px: float

    def rasterised(self) -> "GBuffer":
        """What is seen."""
        fragments = raster.rasterise(
            self.points,
            offsets=self.scene.offsets,
            half_width_px=self.half_width_px,
            alpha=self.scene.alpha,
            mesh_vertices=self.vertices,
            triangles=self.scene.triangles,
            cutouts=self.scene.cutouts,
            width=self.width,
            height=self.height,
            min_width_px=self.min_width_px,
        )
        return GBuffer(scene=self.scene, xy_from_world=self.xy_from_world, fragments=fragments)

    def with_alpha(self, alpha: Array) -> "SceneOnScreen":
        """The same with the strands in other opacities (N,)."""
        return replace(self, scene=replace(self.scene, alpha=np.asarray(alpha, np.float32)))

    def of_points(self, kept: Array) -> "SceneOnScreen":
        """The meshes, and the stretches of strands whose points are `kept` (N,) bool, as strands of their own."""
        strand = strand_of_point(self.scene)[kept]
        place = np.flatnonzero(kept)
        begins = np.flatnonzero((np.diff(strand, prepend=-1) != 0) | (np.diff(place, prepend=-2) != 1))
        scene = replace(self.scene, offsets=np.append(begins, len(place)), alpha=self.scene.alpha[place])
        return replace(self, scene=scene, points=self.points[place], half_width_px=self.half_width_px[place])

    @property
    def pixel(self) -> Array:
        """(N,) int64: the pixel, row * width + column, in which every point lies, or the nearest to it."""
        column = np.clip(self.points[:, 0], 0, self.width - 1).astype(np.int64)
        return np.clip(self.points[:, 1], 0, self.height - 1).astype(np.int64) * self.width + column


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
        return raster.interpolated(per_point, first=self.first, t=self.t)


def on_screen(
    scene: FlatScene,
    *,
    xy_from_world: Array,
    width: int,
    height: int,
    strand_bias_m: float = 0.0,
    min_width_px: float = 1.0,
) -> SceneOnScreen:
    """The scene seen by a camera (3, 4), affine or perspective.

    `strand_bias_m` moves strands towards the camera in the depth test only, so that roots do not fight with the skin.
    """
    points = raster.project(scene.points, xy_from_points=xy_from_world)
    half_width_px = scene.radius * points[:, 3]
    _move_nearer(points, strand_bias_m, xy_from_world)
    return SceneOnScreen(
        scene=scene,
        xy_from_world=np.asarray(xy_from_world, np.float64),
        width=width,
        height=height,
        points=points,
        vertices=raster.project(scene.positions, xy_from_points=xy_from_world),
        half_width_px=half_width_px,
        min_width_px=min_width_px,
    )


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
    """What a camera (3, 4), affine or perspective, sees of the scene; see `on_screen`.

    Raises `InputError` for a number of samples other than 16 and for pictures without pixels.
    """
    if samples != SAMPLES:
        raise InputError(f"samples is {samples}; {SAMPLES} was expected, the only pattern there is.")
    return on_screen(
        scene,
        xy_from_world=xy_from_world,
        width=width,
        height=height,
        strand_bias_m=strand_bias_m,
        min_width_px=min_width_px,
    ).rasterised()


def hair_fragments(gbuffer: GBuffer) -> HairFragments:
    """The fragments that show strands."""
    index = np.flatnonzero(gbuffer.fragments.kind == raster.SEGMENT)
    return HairFragments(index, gbuffer.fragments.primitive[index], gbuffer.fragments.parameter[index, 0])


def hair_coverage(gbuffer: GBuffer) -> Array:
    """(H, W) float32: the share of every pixel in which a strand is seen."""
    fragments = gbuffer.fragments
    seen = np.where(fragments.kind == raster.SEGMENT, fragments.weight, np.float32(0))
    before = np.concatenate([[0.0], np.cumsum(seen, dtype=np.float64)])
    # Weights are multiples of 1/16 or, behind layers, sums of so few numbers that differences stay exact to 1e-12.
    return np.diff(before[fragments.pixel_offsets]).astype(np.float32).reshape(gbuffer.shape)


def visible_weight(gbuffer: GBuffer) -> Array:
    """(N,) float32: how many pixels every point of the strands fills in the picture."""
    return raster.visible_weight(gbuffer.fragments, points=len(gbuffer.scene.points))


def _move_nearer(points: Array, bias_m: float, xy_from_world: Array) -> None:
    if bias_m == 0:
        return
    if np.linalg.norm(np.asarray(xy_from_world)[2, :3]) > 0:
        points[:, 2] /= 1 + points[:, 2] * bias_m
    else:
        points[:, 2] -= bias_m
