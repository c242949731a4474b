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
from tress.render.preview import contact_sheet
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
    """(H, W, 3) uint8: each level near by from two sides; below, each but the first pixel by pixel at its distance,
    and below that the first one from there."""
    spacing = spacing_for(NEAR_PX_PER_M)
    clouds = [
        level_points(document, level, atlases=atlases, spacing_m=spacing, threshold=threshold)
        for level, atlases in zip(chain.levels, chain.atlases, strict=True)
    ]
    near = views_of(clouds, px_per_m=NEAR_PX_PER_M, views=NEAR_VIEWS)
    captions = [f"level {number}: {level.triangles} triangles" for number, level in enumerate(chain.levels)]
    tiles = [[_shown(each[side]) for each in near] for side in range(NEAR_VIEWS)]
    rows = [contact_sheet(row, captions=captions, height=HEIGHT_PX) for row in tiles]
    width = round(tiles[0][0].shape[1] * HEIGHT_PX / tiles[0][0].shape[0])
    if compared:
        rows += [_far_row(compared, width, finest=finest) for finest in (False, True)]
    return np.concatenate(rows)


def _far_row(compared: Sequence[Comparison], width: int, *, finest: bool) -> Array:
    empty = np.full((HEIGHT_PX, width, 3), linear_to_srgb8(BACKDROP), np.uint8)
    views = [(pair.finest if finest else pair.level)[0] for pair in compared]
    captions = [f"level {0 if finest else pair.number} at {pair.distance_m:.1f} m" for pair in compared]
    return contact_sheet(
        [empty, *(_centred(_shown(view), empty) for view in views)],
        captions=["the finest there" if finest else "where each takes over", *captions],
        height=HEIGHT_PX,
    )


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
