"""Colours of meshes in a picture: texture, vertex colours, or plain clay."""

from typing import Any

import numpy as np

from tress.base.color import srgb_to_linear
from tress.model.mesh import Mesh
from tress.render.gbuffer import GBuffer
from tress.render.mesh_fragments import MeshFragments, mesh_fragments
from tress.render.mesh_frames import vertex_normals

Array = np.ndarray[Any, Any]

CLAY = np.array([0.52, 0.47, 0.44], np.float32)
"""Linear colour of meshes that have none of their own; shaded, while the others are flat."""


def mesh_colors(gbuffer: GBuffer) -> tuple[Array, Array]:
    """`index` (K,) of the fragments that show meshes, and their linear colours (K, 3) float32.

    A mesh with a texture shows it, bilinearly filtered and unlit; one with the vertex attribute `color` (V, 3), linear,
    shows that; any other one is clay, lit softly from the camera.
    """
    parts = [(part.index, mesh_color(part, away=gbuffer.away)) for part in mesh_fragments(gbuffer)]
    index = np.concatenate([np.zeros(0, np.int64), *(index for index, _ in parts)])
    return index, np.concatenate([np.zeros((0, 3), np.float32), *(colors for _, colors in parts)])


def mesh_color(part: MeshFragments, *, away: Array) -> Array:
    """(K, 3) float32: linear colours of the fragments of one mesh; see `mesh_colors`."""
    mesh = part.mesh
    if mesh.texture is not None and mesh.corner_uv is not None:
        return bilinear(mesh.texture.pixels[..., :3], uv=part.uv)
    if "color" in mesh.vertex_attributes:
        return part.values(mesh.vertex_attributes["color"])
    normals = part.values(vertex_normals(mesh))
    facing = np.abs(normals @ away) / np.maximum(np.linalg.norm(normals, axis=1), 1e-12)
    return CLAY * (0.25 + 0.75 * facing[:, None]).astype(np.float32)


def base_color(mesh: Mesh) -> Array:
    """(V, 3) float32: the linear colours of the vertices, else the mean of what shows of the texture, else clay."""
    if "color" in mesh.vertex_attributes:
        return mesh.vertex_attributes["color"]
    color = CLAY
    if mesh.texture is not None:
        pixels = mesh.texture.pixels.reshape(-1, mesh.texture.pixels.shape[2])
        weight = pixels[:, 3].astype(np.float64) if pixels.shape[1] == 4 else np.ones(len(pixels))
        color = weight @ srgb_to_linear(pixels[:, :3]) / max(weight.sum(), 1e-9)
    return np.broadcast_to(np.asarray(color, np.float32), (len(mesh.positions), 3))


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
