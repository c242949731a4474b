"""What lies in front in every pixel: the surface that outlines are found in."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tress.render.flat_color import flat_color
from tress.render.gbuffer import GBuffer, hair_fragments
from tress.render.mesh_fragments import MeshFragments, mesh_fragments
from tress.render.mesh_frames import is_cards, vertex_normals

Array = np.ndarray[Any, Any]

FILLED = 0.5
"""Share of a pixel from which on it counts as filled."""
HAIR_PART = -2
"""Part of single strands, which are one."""


@dataclass(frozen=True, eq=False)
class SeenSurface:
    """Pixels of a picture, row by row (P,): `mesh` int32, -1 where nothing is; `strip` int32 within it; `triangle`
    int32; `position` and `normal`, towards the viewer, and `face`, that of the flat triangle, and linear `color`
    (P, 3) float32."""

    mesh: Array
    strip: Array
    triangle: Array
    position: Array
    normal: Array
    face: Array
    color: Array


def seen_surface(gbuffer: GBuffer) -> SeenSurface:
    """The fragment that fills most of each pixel, of those that are at least half filled."""
    front, pixel = _foremost(gbuffer)
    found = _empty(len(front.fragments.pixel_offsets) - 1)
    hair = hair_fragments(front)
    place = pixel[hair.index]
    found.mesh[place] = HAIR_PART
    found.position[place] = hair.values(front.scene.points)
    found.color[place] = hair.values(front.scene.color)
    found.normal[place] = found.face[place] = -front.away
    for number, part in enumerate(mesh_fragments(front)):
        if len(part.index):
            _fill(found, part, pixel[part.index], number, front)
    return found


def _foremost(gbuffer: GBuffer) -> tuple[GBuffer, Array]:
    """The fragments alone that fill most of their pixel, the nearest of several, and their pixels (K,)."""
    fragments = gbuffer.fragments
    offsets, weight = fragments.pixel_offsets, fragments.weight
    count = np.diff(offsets)
    pixel = np.flatnonzero(count)
    starts = offsets[:-1][pixel]
    filled = np.add.reduceat(weight, starts) >= FILLED if len(pixel) else np.zeros(0, bool)
    most = np.maximum.reduceat(weight, starts) if len(pixel) else np.zeros(0, np.float32)
    owner = np.repeat(np.arange(len(pixel)), count[pixel])
    best = np.flatnonzero(weight == most[owner])
    first = best[np.flatnonzero(np.diff(owner[best], prepend=-1))]
    chosen, pixel = first[filled], pixel[filled]
    alone = np.zeros(len(count) + 1, np.int64)
    alone[pixel + 1] = 1
    arrays = {name: getattr(fragments, name)[chosen] for name in ("kind", "primitive", "parameter", "weight", "depth")}
    return replace(gbuffer, fragments=replace(fragments, pixel_offsets=np.cumsum(alone), **arrays)), pixel


def _empty(count: int) -> SeenSurface:
    def number() -> Array:
        return np.full(count, -1, np.int32)

    def vector() -> Array:
        return np.zeros((count, 3), np.float32)

    return SeenSurface(number(), number(), number(), vector(), vector(), vector(), vector())


def _fill(found: SeenSurface, part: MeshFragments, pixel: Array, number: int, gbuffer: GBuffer) -> None:
    mesh, to_eye = part.mesh, -gbuffer.away
    part = replace(part, barycentric=part.barycentric.astype(np.float32))
    found.mesh[pixel], found.triangle[pixel] = number, part.triangle
    found.position[pixel] = part.values(mesh.positions)
    found.color[pixel] = flat_color(part, gbuffer)
    found.normal[pixel] = _towards(part.values(vertex_normals(mesh)), to_eye)
    found.face[pixel] = _towards(_face_normals(mesh.positions, mesh.triangles), to_eye)[part.triangle]
    if is_cards(mesh) and "strip" in mesh.vertex_attributes:
        found.strip[pixel] = mesh.vertex_attributes["strip"][mesh.triangles[part.triangle, 0]]


def _face_normals(positions: Array, triangles: Array) -> Array:
    a, b, c = (positions[triangles[:, corner]] for corner in range(3))
    return np.cross(b - a, c - a)


def _towards(normals: Array, to_eye: Array) -> Array:
    unit = normals / np.linalg.norm(normals, axis=1, keepdims=True).clip(1e-20)
    return (unit * np.where(unit @ to_eye < 0, -1, 1)[:, None]).astype(np.float32)
