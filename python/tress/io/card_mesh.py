"""Strips of one level and one atlas as the arrays that a viewer draws: one mesh, its motion as morph targets."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.model.level import LevelSurface
from tress.model.principal_motion import PrincipalMotion
from tress.model.strip_mesh import texture_coordinates
from tress.model.strip_set import resting_points

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class CardMesh:
    """V vertices and F triangles: `positions`, `normals` (V, 3) and `tangents` (V, 4) float32, the tangent along u with
    the sign of the bitangent; `uv` (V, 2) float32 with v up; `triangles` (F, 3) uint32; `targets` (M, V, 3) float32,
    displacements of the morph targets; `atlas` is the record's name, or "". `fraction` (V, 2) float32 along and across
    the `strip` (V,) int32; `closed` says whether all of them are, as clumps are."""

    atlas: str
    positions: Array
    normals: Array
    tangents: Array
    uv: Array
    triangles: Array
    targets: Array
    fraction: Array
    strip: Array
    closed: bool


def card_mesh(
    document: Document, surface: LevelSurface, *, atlas: str, motion: PrincipalMotion | None = None
) -> CardMesh:
    """The mesh of strips that are all covered with `atlas`, at rest. `motion` is that of the same strips."""
    grid, points = surface.grid, resting_points(surface.strips)
    positions = grid.points(points)
    record = document.records.get(atlas)
    uv = texture_coordinates(grid, surface.strips.records, atlas=record if isinstance(record, Atlas) else None)
    normals, tangents = tangent_frames(positions, triangles=grid.triangles, fraction=grid.fraction)
    shapes = np.zeros((0, *points.shape)) if motion is None else motion.shapes
    targets = [grid.points(shapes[number]).astype(np.float32) for number in range(len(shapes))]
    return CardMesh(
        atlas=atlas,
        positions=positions.astype(np.float32),
        normals=normals,
        tangents=tangents,
        uv=uv,
        triangles=grid.triangles.astype(np.uint32),
        targets=np.array(targets, np.float32).reshape(len(targets), len(positions), 3),
        fraction=grid.fraction.astype(np.float32),
        strip=grid.strip,
        closed=bool(_sides_meet(positions, grid.fraction)),
    )


def _sides_meet(positions: Array, fraction: Array) -> bool:
    """Whether the two sides of every strip are one line; rows of a strip are in order on both."""
    left, right = positions[fraction[:, 1] == 0], positions[fraction[:, 1] == 1]
    return left.shape == right.shape and len(left) > 0 and np.abs(left - right).max() < 1e-6


def tangent_frames(positions: Array, *, triangles: Array, fraction: Array) -> tuple[Array, Array]:
    """Unit normals (V, 3) and tangents (V, 4) float32: across the strip as u runs; the bitangent goes to the root.

    Means over the triangles about a vertex, weighted by area. `fraction` (V, 2) is 0 to 1 along the hair and across.
    """
    a, b, c = (positions[triangles[:, corner]] for corner in range(3))
    face = np.cross(b - a, c - a)
    (along_b, across_b), (along_c, across_c) = (
        (fraction[triangles[:, k]] - fraction[triangles[:, 0]]).T for k in (1, 2)
    )
    sense = np.sign(along_b * across_c - along_c * across_b)[:, None]
    across = ((c - a) * along_b[:, None] - (b - a) * along_c[:, None]) * sense
    normal = _unit(_gathered(face, triangles, len(positions)), fallback=(0.0, 1.0, 0.0))
    tangent = _gathered(across, triangles, len(positions))
    tangent -= (tangent * normal).sum(axis=1, keepdims=True) * normal
    other = np.cross(normal, np.where(np.abs(normal[:, :1]) < 0.9, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
    length = np.linalg.norm(tangent, axis=1, keepdims=True)
    unit = np.where(length > 1e-12, tangent / np.maximum(length, 1e-12), _unit(other, fallback=(1.0, 0.0, 0.0)))
    signed = np.concatenate([unit, np.ones((len(unit), 1))], axis=1)
    return normal.astype(np.float32), signed.astype(np.float32)


def _gathered(of_triangle: Array, triangles: Array, count: int) -> Array:
    total = np.zeros((count, 3))
    for corner in range(3):
        for axis in range(3):
            total[:, axis] += np.bincount(triangles[:, corner], weights=of_triangle[:, axis], minlength=count)
    return total


def _unit(vectors: Array, *, fallback: tuple[float, float, float]) -> Array:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(length > 1e-20, vectors / np.maximum(length, 1e-20), fallback)
