"""Colours of meshes in a picture: texture, vertex colours, or plain clay."""

from typing import Any

import numpy as np

from tress.base.color import srgb_to_linear
from tress.kernel import raster
from tress.model.mesh import Mesh
from tress.render.gbuffer import GBuffer

Array = np.ndarray[Any, Any]

CLAY = np.array([0.52, 0.47, 0.44], np.float32)
"""Linear colour of meshes that have none of their own; shaded, while the others are flat."""


def mesh_colors(gbuffer: GBuffer) -> tuple[Array, Array]:
    """`index` (K,) of the fragments that show meshes, and their linear colours (K, 3) float32.

    A mesh with a texture shows it, bilinearly filtered and unlit; one with the vertex attribute `color` (V, 3), linear,
    shows that; any other one is clay, lit softly from the camera.
    """
    fragments, scene = gbuffer.fragments, gbuffer.scene
    index = np.flatnonzero(fragments.kind == raster.TRIANGLE)
    triangle = fragments.primitive[index]
    bc = fragments.parameter[index]
    barycentric = np.concatenate([1 - bc.sum(axis=1, keepdims=True), bc], axis=1)
    colors = np.zeros((len(index), 3), np.float32)
    owner = np.searchsorted(scene.first_triangle, triangle, side="right") - 1
    for i, mesh in enumerate(scene.meshes):
        mine = owner == i
        colors[mine] = _colors(mesh, triangle[mine] - scene.first_triangle[i], barycentric[mine], gbuffer.away)
    return index, colors


def bilinear(pixels: Array, *, uv: Array) -> Array:
    """(K, C) float32 linear colours of an sRGB texture (H, W, C) uint8 at `uv` (K, 2), v up, clamped at the border."""
    height, width = pixels.shape[:2]
    x = np.clip(uv[:, 0] * width - 0.5, 0, width - 1)
    y = np.clip((1 - uv[:, 1]) * height - 0.5, 0, height - 1)
    column, row = x.astype(np.int64), y.astype(np.int64)
    right, below = np.minimum(column + 1, width - 1), np.minimum(row + 1, height - 1)
    fx, fy = (x - column)[:, None].astype(np.float32), (y - row)[:, None].astype(np.float32)
    upper = srgb_to_linear(pixels[row, column]) * (1 - fx) + srgb_to_linear(pixels[row, right]) * fx
    lower = srgb_to_linear(pixels[below, column]) * (1 - fx) + srgb_to_linear(pixels[below, right]) * fx
    return upper * (1 - fy) + lower * fy


def _colors(mesh: Mesh, triangle: Array, barycentric: Array, away: Array) -> Array:
    if mesh.texture is not None and mesh.corner_uv is not None:
        uv = np.einsum("kc,kcd->kd", barycentric, mesh.corner_uv[triangle])
        return bilinear(mesh.texture.pixels[..., :3], uv=uv)
    corners = mesh.triangles[triangle]
    if "color" in mesh.vertex_attributes:
        return np.einsum("kc,kcd->kd", barycentric, mesh.vertex_attributes["color"][corners])
    normals = np.einsum("kc,kcd->kd", barycentric, _vertex_normals(mesh)[corners])
    facing = np.abs(normals @ away) / np.maximum(np.linalg.norm(normals, axis=1), 1e-12)
    return CLAY * (0.25 + 0.75 * facing[:, None]).astype(np.float32)


def _vertex_normals(mesh: Mesh) -> Array:
    """(V, 3): sums of the area normals of the triangles around every vertex."""
    a, b, c = (mesh.positions[mesh.triangles[:, i]] for i in range(3))
    of_triangle = np.cross(b - a, c - a)
    normals = np.zeros_like(mesh.positions)
    for i in range(3):
        np.add.at(normals, mesh.triangles[:, i], of_triangle)
    return normals
