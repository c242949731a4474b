"""Strips as one triangle mesh: what there is to see of a group."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.model.mesh import Mesh
from tress.model.strip import Strip
from tress.model.strip_grid import StripGrid, strip_grid
from tress.model.strip_set import posed_points, strip_set
from tress.model.texture import Texture

Array = np.ndarray[Any, Any]

WHOLE_PICTURE = (0.0, 0.0, 1.0, 1.0)


def strips_mesh(
    document: Document, *, names: Sequence[str], time: float = 0.0, pieces: tuple[int, int] | None = None
) -> Mesh:
    """The strips `names` at `time` (seconds) as one mesh, every span in `pieces` (see `strip_grid`).

    Its triangles and texture coordinates are the same at every time. Vertex attributes: `strip` int32, the place in
    `names`; `fraction` (V, 2) float32, root to tip and across. The texture is that of the strips' atlas.
    Raises `InputError` where they have several.
    """
    strips = strip_set(document, names)
    grid = strip_grid(strips.records, pieces=pieces)
    atlas = _common_atlas(document, strips.records)
    return Mesh(
        positions=grid.points(posed_points(strips, time)),
        triangles=grid.triangles,
        corner_uv=texture_coordinates(grid, strips.records, atlas=atlas)[grid.triangles],
        vertex_attributes={"strip": grid.strip, "fraction": grid.fraction.astype(np.float32)},
        texture=None if atlas is None else Texture(pixels=atlas.color),
    )


def texture_coordinates(grid: StripGrid, strips: Sequence[Strip], *, atlas: Atlas | None) -> Array:
    """(Q, 2) float32 texture coordinates of the grid's points: the root at the upper edge of the strip's region."""
    regions = np.array([WHOLE_PICTURE if atlas is None else atlas.regions[strip.region] for strip in strips])
    low, high = np.split(regions.reshape(-1, 4)[grid.strip], 2, axis=1)
    share = np.stack([grid.fraction[:, 1], 1 - grid.fraction[:, 0]], axis=1)
    return (low * (1 - share) + high * share).astype(np.float32)


def _common_atlas(document: Document, strips: Sequence[Strip]) -> Atlas | None:
    names = sorted({strip.atlas for strip in strips})
    if len(names) > 1:
        raise InputError(f"One mesh has one atlas; {', '.join(name or 'none' for name in names)} were found.")
    atlas = document.records.get(names[0]) if names else None
    return atlas if isinstance(atlas, Atlas) else None
