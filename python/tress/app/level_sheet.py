"""Levels of detail side by side: near by, and as small as they are where they take over."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from tress.base.color import linear_to_srgb8
from tress.methods.strips.level_likeness import level_points, spacing_for, views_of
from tress.methods.strips.levels import LevelChain
from tress.model.document import Document
from tress.render.card_points import CardView
from tress.render.preview import GAP_PX, contact_sheet
from tress.render.turntable import BACKDROP

Array = np.ndarray[Any, Any]

NEAR_PX_PER_M, NEAR_VIEWS = 900.0, 2
HEIGHT_PX = 420


@dataclass(frozen=True, eq=False)
class Comparison:
    """The views of level `number` and of the finest one at the distance where it takes over (metres)."""

    number: int
    distance_m: float
    level: Sequence[CardView]
    finest: Sequence[CardView]


def level_sheet(
    document: Document, chain: LevelChain, *, compared: Sequence[Comparison] = (), threshold: float = 0.5
) -> Array:
    """(H, W, 3) uint8: each level near by from two sides; below, each but the first pixel by pixel at its distance, and
    beside it the first one from there."""
    spacing = spacing_for(NEAR_PX_PER_M)
    clouds = [
        level_points(document, level, atlases=atlases, spacing_m=spacing, threshold=threshold)
        for level, atlases in zip(chain.levels, chain.atlases, strict=True)
    ]
    near = views_of(clouds, px_per_m=NEAR_PX_PER_M, views=NEAR_VIEWS)
    captions = [f"level {number}: {level.triangles} triangles" for number, level in enumerate(chain.levels)]
    tiles = [[_shown(each[side]) for each in near] for side in range(NEAR_VIEWS)]
    rows = [contact_sheet(row, captions=captions, height=HEIGHT_PX) for row in tiles]
    if compared:
        rows.append(_far_row(compared, rows[0].shape[1]))
    return np.concatenate(rows)


def _far_row(compared: Sequence[Comparison], width: int) -> Array:
    """(H, width, 3): every level beside the finest one, as small as both are where it takes over."""
    count = 2 * len(compared)
    room = width - (count + 1) * GAP_PX
    widths = [room // count + (place < room % count) for place in range(count)]
    pictures, captions = [], []
    for pair in compared:
        for number, views in ((pair.number, pair.level), (0, pair.finest)):
            empty = np.full((HEIGHT_PX, widths[len(pictures)], 3), linear_to_srgb8(BACKDROP), np.uint8)
            pictures.append(_centred(_shown(views[0]), empty))
            captions.append(f"level {number} at {pair.distance_m:.1f} m")
    return contact_sheet(pictures, captions=captions, height=HEIGHT_PX)


def _centred(picture: Array, empty: Array) -> Array:
    """The picture in the middle of an empty one, made smaller only where it does not fit."""
    scale = min(1.0, *(room / size for room, size in zip(empty.shape[:2], picture.shape[:2], strict=True)))
    if scale < 1:
        size = [max(int(side * scale), 1) for side in picture.shape[1::-1]]
        picture = cv2.resize(picture, size, interpolation=cv2.INTER_AREA)
    top, left = ((room - size) // 2 for room, size in zip(empty.shape[:2], picture.shape[:2], strict=True))
    found = empty.copy()
    found[top : top + picture.shape[0], left : left + picture.shape[1]] = picture
    return found


def _shown(view: CardView) -> Array:
    return linear_to_srgb8(view.color + (1 - view.filled[..., None]) * BACKDROP)
