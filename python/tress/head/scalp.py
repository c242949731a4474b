"""Where hair grows: seeded roots, evenly spread over the scalp.

The scalp's triangles are about 12 mm wide, too coarse for a hairline: each is cut into smaller ones, each small one
counts by its area and by the scalp mask at its middle, and the roots are drawn in equal steps along the running sum.
Neighbours in that sum are neighbours on the head, so the roots lie more evenly than independent ones would.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError


@dataclass(frozen=True)
class ScalpRoots:
    """N roots on a mesh: `triangle` (N,) int32, `barycentric` (N, 3) float32, `positions` and unit outward `normals`
    (N, 3) float64 in the space of the mesh."""

    triangle: NDArray[np.int32]
    barycentric: NDArray[np.float32]
    positions: NDArray[np.float64]
    normals: NDArray[np.float64]


def scalp_roots(
    positions: NDArray[np.floating],
    *,
    triangles: NDArray[np.integer],
    scalp: NDArray[np.floating],
    count: int,
    seed: int,
    subdivisions: int = 2,
) -> ScalpRoots:
    """`count` roots on the mesh with vertices (V, 3) and `triangles` (F, 3), as dense as the mask `scalp` (V,) in [0,
    1] says.

    Deterministic per `seed`. Raises `InputError` where the mask is empty. Linear in F 4^subdivisions + count.
    """
    pieces = subdivided_triangle(subdivisions)
    used = np.flatnonzero((scalp[triangles] > 0).any(axis=1))
    corners = np.asarray(positions, np.float64)[triangles[used]]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    middles = pieces.mean(axis=1)
    density = np.einsum("pk,fk->fp", middles, scalp[triangles[used]].astype(np.float64)) * area[:, None]
    running = np.cumsum(density.ravel())
    if not len(running) or running[-1] <= 0:
        raise InputError("The scalp mask is empty; a mask above 0 on some vertices was expected.")
    rng = np.random.default_rng(seed)
    steps = (np.arange(count) + rng.random(count)) / count * running[-1]
    chosen = np.minimum(np.searchsorted(running, steps, side="right"), len(running) - 1)
    face, piece = np.divmod(chosen, len(pieces))
    barycentric = np.einsum("nk,nkj->nj", _uniform_barycentric(rng, count), pieces[piece])
    normals = vertex_normals(positions, triangles=triangles)
    vertices = triangles[used[face]]
    normal = np.einsum("nk,nkd->nd", barycentric, normals[vertices])
    return ScalpRoots(
        triangle=used[face].astype(np.int32),
        barycentric=barycentric.astype(np.float32),
        positions=np.einsum("nk,nkd->nd", barycentric, np.asarray(positions, np.float64)[vertices]),
        normals=normal / np.linalg.norm(normal, axis=1, keepdims=True),
    )


def subdivided_triangle(levels: int) -> NDArray[np.float64]:
    """The 4^levels pieces of a triangle, neighbours in order: barycentric coordinates of their corners (P, 3, 3)."""
    pieces = np.eye(3)[None]
    for _ in range(levels):
        a, b, c = pieces[:, 0], pieces[:, 1], pieces[:, 2]
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        quarters = [(a, ab, ca), (ab, b, bc), (ab, bc, ca), (ca, bc, c)]
        pieces = np.stack([np.stack(quarter, axis=1) for quarter in quarters], axis=1).reshape(-1, 3, 3)
    return pieces


def vertex_normals(positions: NDArray[np.floating], *, triangles: NDArray[np.integer]) -> NDArray[np.float64]:
    """Unit normals (V, 3) at the vertices, triangles counted by their area."""
    corners = np.asarray(positions, np.float64)[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat = np.repeat(normal, 3, axis=0)
    vertex = triangles.ravel()
    total = np.stack([np.bincount(vertex, weights=flat[:, k], minlength=len(positions)) for k in range(3)], axis=1)
    return total / np.linalg.norm(total, axis=1, keepdims=True).clip(min=1e-30)


def _uniform_barycentric(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    root, share = np.sqrt(rng.random(count)), rng.random(count)
    return np.stack([1 - root, root * (1 - share), root * share], axis=1)
