"""How a level of detail compares with the finest one, where it takes over."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.color import linear_to_srgb
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.model.head import Head
from tress.model.level import Level, level_surface
from tress.model.mesh import Mesh
from tress.model.strip_mesh import texture_coordinates
from tress.model.strip_set import resting_points
from tress.model.texture import Texture
from tress.render.card_points import PER_SAMPLE, CardPoints, CardView, card_points, card_view

Array = np.ndarray[Any, Any]

VIEWS = 4
SAMPLES = 2
HALF = 0.5
MARGIN = 1.15


@dataclass(frozen=True)
class Likeness:
    """Means over four views about the head: `silhouette_iou` of the pixels that are at least half hair, in [0, 1];
    `coverage`, the hair's area over that of the finest level; `color_difference`, the largest difference of the mean
    sRGB colours of the hair, in steps of 1 / 255."""

    silhouette_iou: float
    coverage: float
    color_difference: float


def level_points(
    document: Document, level: Level, *, atlases: Mapping[str, Atlas], spacing_m: float, threshold: float = 0.5
) -> CardPoints:
    """The textured points of a level, in front of the heads of the document. `atlases` are those of the level."""
    heads = [head.mesh for head in document.of_type(Head).values()]
    return card_points(level_meshes(document, level, atlases=atlases), heads, spacing_m=spacing_m, threshold=threshold)


def level_meshes(document: Document, level: Level, *, atlases: Mapping[str, Atlas]) -> list[Mesh]:
    """A textured mesh of every atlas of a level, at rest."""
    surface = level_surface(document, level)
    positions = surface.grid.points(resting_points(surface.strips))
    names = np.array([strip.atlas for strip in surface.strips.records])
    uv = np.zeros((len(positions), 2), np.float32)
    for name in np.unique(names):
        mine = names[surface.grid.strip] == name
        uv[mine] = texture_coordinates(surface.grid, surface.strips.records, atlas=atlases.get(str(name)))[mine]
    meshes = []
    for name in np.unique(names):
        triangles = surface.grid.triangles[names[surface.grid.strip[surface.grid.triangles[:, 0]]] == name]
        atlas = atlases.get(str(name))
        texture = None if atlas is None else Texture(pixels=atlas.color)
        meshes.append(Mesh(positions=positions, triangles=triangles, corner_uv=uv[triangles], texture=texture))
    return meshes


@dataclass(frozen=True, eq=False)
class Frame:
    """`matrices` (3, 4) of affine cameras from around, and the size of their pictures in pixels."""

    matrices: tuple[Array, ...]
    width: int
    height: int


def frame_about(points: CardPoints, *, px_per_m: float, views: int = VIEWS) -> Frame:
    """Cameras from `views` directions that keep the hair in the picture."""
    hair = points.positions[points.hair]
    low, high = hair.min(axis=0), hair.max(axis=0)
    centre, size = 0.5 * (low + high), MARGIN * np.linalg.norm((high - low)[[0, 2]])
    width, height = (max(int(px_per_m * side) + 2, 4) for side in (size, MARGIN * (high - low)[1]))
    matrices = [
        _camera(2 * np.pi * k / views, centre=centre, scale=px_per_m, width=width, height=height) for k in range(views)
    ]
    return Frame(tuple(matrices), width, height)


def seen_in(frame: Frame, points: CardPoints) -> list[CardView]:
    """The pictures of one cloud."""
    return [
        card_view(points, xy_from_world=matrix, width=frame.width, height=frame.height, samples=SAMPLES)
        for matrix in frame.matrices
    ]


def views_of(points: Sequence[CardPoints], *, px_per_m: float, views: int = VIEWS) -> list[list[CardView]]:
    """For each of several clouds its pictures from `views` directions around, in the frame of the first."""
    frame = frame_about(points[0], px_per_m=px_per_m, views=views)
    return [seen_in(frame, each) for each in points]


def spacing_for(px_per_m: float) -> float:
    """How far points may lie apart for pictures of so many pixels a metre."""
    return 1 / (px_per_m * SAMPLES * np.sqrt(PER_SAMPLE))


def likeness(views: Sequence[CardView], reference: Sequence[CardView]) -> Likeness:
    """How views compare with those of the finest level from the same cameras."""
    pairs = list(zip(views, reference, strict=True))
    masks = [(mine.hair >= HALF, other.hair >= HALF) for mine, other in pairs]
    ious = [(a & b).sum() / max((a | b).sum(), 1) for a, b in masks]
    covered = [mine.hair.sum() / max(other.hair.sum(), 1e-9) for mine, other in pairs]
    colors = [_mean_color(views), _mean_color(reference)]
    return Likeness(
        silhouette_iou=float(np.mean(ious)),
        coverage=float(np.mean(covered)),
        color_difference=float(255 * np.abs(colors[0] - colors[1]).max()),
    )


def _mean_color(views: Sequence[CardView]) -> Array:
    """(3,) mean sRGB of the pixels that are at least half hair, in [0, 1]."""
    seen = np.concatenate([view.color[view.hair >= HALF] / view.hair[view.hair >= HALF, None] for view in views])
    return linear_to_srgb(seen.mean(axis=0)) if len(seen) else np.zeros(3)


def _camera(azimuth: float, *, centre: Array, scale: float, width: int, height: int) -> Array:
    right = np.array([np.cos(azimuth), 0.0, -np.sin(azimuth)])
    rows = scale * np.stack([right, [0.0, -1.0, 0.0]])
    middle = np.array([width, height]) / 2 - rows @ centre
    return np.vstack([np.column_stack([rows, middle]), [0, 0, 0, 1]])
