"""A texture read as finely as the picture shows it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from tress.kernel import raster
from tress.render.gbuffer import GBuffer
from tress.render.mesh_fragments import MeshFragments

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class TexturePlaces:
    """Where K fragments lie on a texture (H, W): `uv` (K, 2), v up, and `level` (K,) int64, halvings that are as fine
    as the picture."""

    uv: Array
    level: Array

    def read(self, pixels: Array, *, decode: Callable[[Array], Array]) -> Array:
        """(K, C) float32: bytes (H, W, C), decoded and then averaged over what a pixel of the picture shows."""
        values = np.atleast_3d(decode(pixels)).astype(np.float32)
        found = np.zeros((len(self.uv), values.shape[2]), np.float32)
        for level in range(int(self.level.max(initial=0)) + 1):
            mine = self.level == level
            if mine.any():
                found[mine] = _bilinear(values, self.uv[mine])
            size = (max(values.shape[1] // 2, 1), max(values.shape[0] // 2, 1))
            values = np.atleast_3d(cv2.resize(values, size, interpolation=cv2.INTER_AREA))
        return found


def texture_places(gbuffer: GBuffer, part: MeshFragments) -> TexturePlaces:
    """Where the fragments of a mesh lie on its texture. The level is that of their triangles, by area."""
    mesh = part.mesh
    assert mesh.texture is not None and mesh.corner_uv is not None
    height, width = mesh.texture.pixels.shape[:2]
    on_screen = raster.project(mesh.positions, xy_from_points=gbuffer.xy_from_world)[:, :2][mesh.triangles]
    texels = np.abs(_doubled_areas(mesh.corner_uv)) * height * width
    ratio = texels / np.maximum(np.abs(_doubled_areas(on_screen)), 1e-6)
    most = np.log2(min(height, width))
    level = np.clip(np.round(0.5 * np.log2(np.maximum(ratio, 1e-12))), 0, most).astype(np.int64)
    return TexturePlaces(part.uv, level[part.triangle])


def _doubled_areas(corners: Array) -> Array:
    """(F,) twice the signed areas of triangles (F, 3, 2)."""
    a, b = (corners[:, i].astype(np.float64) - corners[:, 0] for i in (1, 2))
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _bilinear(values: Array, uv: Array) -> Array:
    height, width = values.shape[:2]
    x = np.clip(uv[:, 0] * width - 0.5, 0, width - 1)
    y = np.clip((1 - uv[:, 1]) * height - 0.5, 0, height - 1)
    column, row = x.astype(np.int64), y.astype(np.int64)
    right, below = np.minimum(column + 1, width - 1), np.minimum(row + 1, height - 1)
    fx, fy = (x - column)[:, None].astype(np.float32), (y - row)[:, None].astype(np.float32)
    upper = values[row, column] * (1 - fx) + values[row, right] * fx
    lower = values[below, column] * (1 - fx) + values[below, right] * fx
    return upper * (1 - fy) + lower * fy
