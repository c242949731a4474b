"""Outlines for viewers without shaders: a surface grown by the width of the line, turned inside out and dark.

Viewers do not draw what faces away, so only the part that sticks out behind the silhouette is seen. A strip, which has
two sides and a border, gets a shell on either side, each turned away from the strip and grown beyond its border: seen
from one side, the shell behind it shows. Strips nearer to each other than the width hide each other's lines: they meld.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Hull:
    """`shift` (W, 3) float32 of the vertices `vertex` (W,) of the surface; `triangles` (F, 3) of the W vertices."""

    vertex: Array
    shift: Array
    triangles: Array


def inverted_hull(positions: Array, *, normals: Array, triangles: Array, width_m: float) -> Hull:
    """The shell of a surface (V, 3) with unit `normals` (V, 3); two shells where it has a border."""
    welded = _welded(positions)
    border, open_part = _border(positions, welded, triangles, normals)
    outwards = width_m * (normals + border)
    behind = width_m * (border - normals)
    count = len(positions)
    both = open_part[triangles[:, 0]]
    faces = np.concatenate([triangles[:, ::-1], triangles[both] + count])
    used, renumbered = np.unique(faces, return_inverse=True)
    shift = np.concatenate([outwards, behind])[used].astype(np.float32)
    return Hull(used % count, shift, renumbered.reshape(-1, 3).astype(np.uint32))


def _welded(positions: Array) -> Array:
    """(V,) one number for all vertices in one place, to a hundredth of a millimetre."""
    return np.unique(np.round(positions.astype(np.float64) * 1e5), axis=0, return_inverse=True)[1].reshape(-1)


def _border(positions: Array, welded: Array, triangles: Array, normals: Array) -> tuple[Array, Array]:
    """(V, 3) unit directions out of the surface at its border, 0 elsewhere, and (V,) whether the part has one."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    ends = np.sort(welded[edges], axis=1)
    kept = ends[:, 0] != ends[:, 1]
    edges, ends = edges[kept], ends[kept]
    _, first, number = np.unique(ends, axis=0, return_index=True, return_counts=True)
    rim = edges[first[number == 1]]
    along = positions[rim[:, 1]] - positions[rim[:, 0]]
    out = np.zeros((len(positions), 3))
    for corner in (0, 1):
        np.add.at(out, rim[:, corner], np.cross(along, normals[rim[:, corner]]))
    length = np.linalg.norm(out, axis=1, keepdims=True)
    parts = _parts(welded, triangles, len(positions))
    has_border = np.zeros(int(parts.max()) + 1 if len(parts) else 0, bool)
    has_border[parts[rim.ravel()]] = True
    return np.divide(out, length, out=np.zeros_like(out), where=length > 1e-12), has_border[parts]


def _parts(welded: Array, triangles: Array, count: int) -> Array:
    """(V,) number of the connected part of every vertex."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    corners = welded[triangles]
    a, b = corners[:, [0, 1]].T.ravel(), corners[:, [1, 2]].T.ravel()
    size = int(welded.max()) + 1 if count else 0
    graph = coo_array((np.ones(len(a), bool), (a, b)), shape=(size, size))
    return connected_components(graph, directed=False)[1][welded]
