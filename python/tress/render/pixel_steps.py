"""How values on a mesh change from a fragment to the next pixel: what keeps drawn edges one pixel sharp."""

from collections.abc import Callable
from typing import Any

import numpy as np

from tress.kernel import raster
from tress.render.gbuffer import GBuffer
from tress.render.mesh_fragments import MeshFragments

Array = np.ndarray[Any, Any]


def with_slope(gbuffer: GBuffer, part: MeshFragments, value: Callable[[Array], Array]) -> tuple[Array, Array]:
    """`value` (K,) of the fragments of a mesh, and how much it changes within a pixel (K,).

    `value` takes barycentric coordinates (K, 3) of the fragments, also such a little outside their triangles. Exact for
    affine cameras where the value is linear on a triangle; with perspective, as far as a pixel is small.
    """
    rightwards, downwards = barycentric_steps(gbuffer, part)
    here = value(part.barycentric)
    step = np.hypot(value(part.barycentric + rightwards) - here, value(part.barycentric + downwards) - here)
    return here, step


def barycentric_steps(gbuffer: GBuffer, part: MeshFragments) -> tuple[Array, Array]:
    """(K, 3) twice: the change of the barycentric coordinates a pixel to the right, and one down."""
    xy = raster.project(part.mesh.positions, xy_from_points=gbuffer.xy_from_world)[:, :2].astype(np.float64)
    a, b, c = (xy[part.mesh.triangles[:, corner]] for corner in range(3))
    first, second = b - a, c - a
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    area = np.where(np.abs(area) < 1e-9, np.inf, area)
    right = np.stack([second[:, 1], -first[:, 1]], axis=1) / area[:, None]
    down = np.stack([-second[:, 0], first[:, 0]], axis=1) / area[:, None]
    return _all_three(right)[part.triangle], _all_three(down)[part.triangle]


def _all_three(steps: Array) -> Array:
    return np.concatenate([-steps.sum(axis=1, keepdims=True), steps], axis=1)
