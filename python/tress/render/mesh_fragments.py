"""The fragments that show meshes, mesh by mesh."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.kernel import raster
from tress.model.mesh import Mesh
from tress.render.gbuffer import GBuffer

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class MeshFragments:
    """The K fragments that show one mesh: `index` (K,) into all, `triangle` (K,) of the mesh, `barycentric` (K, 3).

    `vertices` are those of the mesh among all of the scene; `maps` are the further pictures of its atlas.
    """

    mesh: Mesh
    maps: Mapping[str, Array]
    vertices: slice
    index: Array
    triangle: Array
    barycentric: Array

    def values(self, per_vertex: Array) -> Array:
        """(K, ...) values (V, ...) of the vertices of the mesh, interpolated."""
        return np.einsum("kc,kc...->k...", self.barycentric, per_vertex[self.mesh.triangles[self.triangle]])

    @property
    def uv(self) -> Array:
        """(K, 2) texture coordinates."""
        assert self.mesh.corner_uv is not None
        return np.einsum("kc,kcd->kd", self.barycentric, self.mesh.corner_uv[self.triangle])


def mesh_fragments(gbuffer: GBuffer) -> Iterator[MeshFragments]:
    """The meshes of the scene in their order, those too that are not seen."""
    fragments, scene = gbuffer.fragments, gbuffer.scene
    index = np.flatnonzero(fragments.kind == raster.TRIANGLE)
    triangle = fragments.primitive[index]
    bc = fragments.parameter[index]
    barycentric = np.concatenate([1 - bc.sum(axis=1, keepdims=True), bc], axis=1)
    owner = np.searchsorted(scene.first_triangle, triangle, side="right") - 1
    first_vertex = np.cumsum([0, *(len(mesh.positions) for mesh in scene.meshes)])
    maps = scene.maps or ({},) * len(scene.meshes)
    for i, mesh in enumerate(scene.meshes):
        mine = owner == i
        yield MeshFragments(
            mesh=mesh,
            maps=maps[i],
            vertices=slice(first_vertex[i], first_vertex[i + 1]),
            index=index[mine],
            triangle=triangle[mine] - scene.first_triangle[i],
            barycentric=barycentric[mine],
        )
