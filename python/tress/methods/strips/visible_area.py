"""How much of every strip is seen from around."""

from typing import Any

import numpy as np

from tress.kernel import raster
from tress.model.document import Document
from tress.model.head import Head
from tress.model.strip_grid import StripGrid, strip_grid
from tress.model.strip_set import StripSet, posed_points

Array = np.ndarray[Any, Any]

AZIMUTHS, ELEVATIONS_RAD = 8, (-0.25, 0.3, 0.85)
PICTURE_PX = 256


def visible_area(document: Document, strips: StripSet, *, grid: StripGrid | None = None) -> Array:
    """(S,) float64: square metres of every strip in sight, in the mean over 25 directions: around, and from above.

    Other strips and the heads hide what lies behind them; strips count as opaque.
    """
    grid = grid or strip_grid(strips.records)
    points = grid.points(posed_points(strips))
    heads = [head.mesh for head in document.of_type(Head).values()]
    positions = np.concatenate([points, *(head.positions for head in heads)])
    starts = np.cumsum([len(points), *(len(head.positions) for head in heads)])
    triangles = [grid.triangles, *(head.triangles + start for head, start in zip(heads, starts, strict=False))]
    found = [_seen(positions, np.concatenate(triangles), matrix) for matrix in view_matrices(points)]
    of_triangle = np.mean(found, axis=0)[: len(grid.triangles)]
    return np.bincount(grid.strip[grid.triangles[:, 0]], weights=of_triangle, minlength=len(strips.records))


def view_matrices(points: Array) -> list[Array]:
    """(3, 4) orthographic cameras about the points, each with a picture of 256 x 256 pixels."""
    low, high = points.min(axis=0), points.max(axis=0)
    centre, size = 0.5 * (low + high), max(float(np.linalg.norm(high - low)), 1e-6)
    scale = PICTURE_PX / size
    angles = [(2 * np.pi * k / AZIMUTHS, up) for up in ELEVATIONS_RAD for k in range(AZIMUTHS)] + [(0.0, np.pi / 2)]
    return [_matrix(azimuth, up, centre, scale) for azimuth, up in angles]


def _matrix(azimuth: float, elevation: float, centre: Array, scale: float) -> Array:
    away = -np.array([np.sin(azimuth) * np.cos(elevation), np.sin(elevation), np.cos(azimuth) * np.cos(elevation)])
    right = np.array([np.cos(azimuth), 0.0, -np.sin(azimuth)])
    down = np.cross(away, right)
    rows = scale * np.stack([right, down])
    middle = PICTURE_PX / 2 - rows @ centre
    return np.vstack([np.column_stack([rows, middle]), [0, 0, 0, 1]])


def _seen(positions: Array, triangles: Array, matrix: Array) -> Array:
    """(F,) square metres of every triangle in sight."""
    fragments = raster.rasterise(
        np.zeros((0, 4)),
        offsets=np.zeros(1, np.int64),
        half_width_px=np.zeros(0),
        alpha=np.zeros(0),
        mesh_vertices=raster.project(positions, xy_from_points=matrix),
        triangles=triangles,
        width=PICTURE_PX,
        height=PICTURE_PX,
    )
    scale = np.linalg.norm(matrix[0, :3])
    return np.bincount(fragments.primitive, weights=fragments.weight, minlength=len(triangles)) / scale**2
