"""A scene as flat arrays: what the rasteriser and the styles read."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.kernel.raster import OPAQUE, Cutouts
from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.strands import Strands

Array = np.ndarray[Any, Any]

DEFAULT_RADIUS_M = 4e-5
"""Radius of a human hair of 0.08 mm."""
DEFAULT_COLOR = (0.10, 0.06, 0.04)
"""Linear brown of strands that have no colour."""


@dataclass(frozen=True, eq=False)
class FlatScene:
    """All strands and all meshes of a scene, one after the other; strands without an attribute get its default.

    `points` (N, 3), `offsets` (S + 1,), `color` (N, 3) linear, `alpha` (N,), `radius` (N,) metres: float32 but for the
    offsets, int64. `positions` (V, 3) float32, `triangles` (F, 3) int32 into `positions`. `meshes` are the records, and
    `first_triangle` (len(meshes) + 1,) tells which triangles are theirs. `cutouts` are the opacities of their textures,
    `maps` further pictures of every mesh by name (see `Atlas.maps`). `tangent` (N, 3), `sky` (N,) and `mesh_sky` (V,)
    are what styles need and is the same for every view: None until `prepared`.
    """

    points: Array
    offsets: Array
    color: Array
    alpha: Array
    radius: Array
    positions: Array
    triangles: Array
    meshes: tuple[Mesh, ...]
    first_triangle: Array
    cutouts: Cutouts = OPAQUE
    maps: tuple[Mapping[str, Array], ...] = ()
    tangent: Array | None = None
    sky: Array | None = None
    mesh_sky: Array | None = None


def flat_scene(
    scene: Scene,
    *,
    radius_m: float | None = None,
    see_through: bool = True,
    maps: Mapping[str, Mapping[str, Array]] | None = None,
) -> FlatScene:
    """The scene as flat arrays.

    `radius_m` replaces the radius of every strand. Textures with an alpha let see through unless `see_through` says no.
    `maps` are further pictures of a mesh, by its name and theirs, such as the `normal` and `flow` of an atlas.

    >>> strands = Strands(points=[[0, 0, 0], [0, 1, 0]], offsets=[0, 2])
    >>> flat_scene(Scene(strands={"hair": strands})).alpha.tolist()
    [1.0, 1.0]
    """
    hair = tuple(scene.strands.values())
    meshes = tuple(scene.meshes.values())
    radius = _per_point(hair, "radius", DEFAULT_RADIUS_M)
    return FlatScene(
        points=_stacked([s.points for s in hair], (0, 3), np.float32),
        offsets=_joined_offsets([s.offsets for s in hair]),
        color=_per_point(hair, "color", DEFAULT_COLOR),
        alpha=_per_point(hair, "alpha", 1.0),
        radius=radius if radius_m is None else np.full_like(radius, radius_m),
        positions=_stacked([m.positions for m in meshes], (0, 3), np.float32),
        triangles=_joined_triangles(meshes),
        meshes=meshes,
        first_triangle=np.cumsum([0, *(len(m.triangles) for m in meshes)]),
        cutouts=cutouts_of(meshes) if see_through else OPAQUE,
        maps=tuple((maps or {}).get(name, {}) for name in scene.meshes),
    )


def tangents(scene: FlatScene) -> Array:
    """(N, 3) float32 unit directions root to tip at every point, by central differences within the strand."""
    if scene.tangent is not None:
        return scene.tangent
    points, last = scene.points, scene.offsets[1:] - 1
    index = np.arange(len(points))
    before, after = np.maximum(index - 1, 0), np.minimum(index + 1, max(len(points) - 1, 0))
    before[scene.offsets[:-1]] = scene.offsets[:-1]
    after[last] = last
    along = points[after] - points[before]
    return along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)


def strand_of_point(scene: FlatScene) -> Array:
    """(N,) int64: the strand to which every point belongs."""
    return np.repeat(np.arange(len(scene.offsets) - 1), np.diff(scene.offsets))


def cutouts_of(meshes: tuple[Mesh, ...]) -> Cutouts:
    """The alphas of the textures that have one which is not 255 throughout."""
    pictures, of_triangle, corner_uv = [], [], []
    for mesh in meshes:
        through = _alpha(mesh)
        of_triangle.append(np.full(len(mesh.triangles), -1 if through is None else len(pictures), np.int32))
        known = through is not None and mesh.corner_uv is not None
        corner_uv.append(mesh.corner_uv if known else np.zeros((len(mesh.triangles), 3, 2), np.float32))
        pictures += [] if through is None else [through]
    return Cutouts(pictures, np.concatenate(of_triangle), np.concatenate(corner_uv)) if pictures else OPAQUE


def _alpha(mesh: Mesh) -> Array | None:
    if mesh.texture is None or mesh.corner_uv is None or mesh.texture.pixels.shape[2] != 4:
        return None
    alpha = mesh.texture.pixels[..., 3]
    return None if alpha.min() == 255 else np.ascontiguousarray(alpha)


def _per_point(hair: tuple[Strands, ...], name: str, default: Any) -> Array:
    shape = np.shape(default)
    parts = [
        s.point_attributes[name] if name in s.point_attributes else np.broadcast_to(default, (len(s.points), *shape))
        for s in hair
    ]
    return _stacked(parts, (0, *shape), np.float32)


def _stacked(parts: list[Array], empty_shape: tuple[int, ...], dtype: Any) -> Array:
    return np.concatenate([np.zeros(empty_shape, dtype), *parts]).astype(dtype, copy=False)


def _joined_offsets(parts: list[Array]) -> Array:
    lengths = [np.diff(offsets) for offsets in parts]
    return np.cumsum(np.concatenate([[0], *lengths])).astype(np.int64)


def _joined_triangles(meshes: tuple[Mesh, ...]) -> Array:
    first_vertex = np.cumsum([0, *(len(m.positions) for m in meshes)])
    parts = [m.triangles + first for m, first in zip(meshes, first_vertex, strict=False)]
    return _stacked(parts, (0, 3), np.int32)
