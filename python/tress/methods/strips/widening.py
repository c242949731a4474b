"""How much wider strips become where others went."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from tress.methods.strips.level_likeness import frame_about, level_points, seen_in, spacing_for
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.model.level import Level
from tress.render.card_points import CardView

Array = np.ndarray[Any, Any]

STEPS = 5
VIEWS = 3
MOST = 1.5


def widened(
    document: Document,
    level: Level,
    *,
    share: Array,
    atlases: Mapping[str, Atlas],
    finest: tuple[Level, Mapping[str, Atlas]],
    px_per_m: float,
    threshold: float,
) -> Level:
    """The level with strips widened until hair covers as much of a picture as on the `finest` level with its atlases.

    The factors follow `share` (S,), which says how much each strip stands for, all by the same power of
    it. The pictures are textured and alpha-tested, with `px_per_m` pixels a metre, as where the level takes over.
    """
    spacing = spacing_for(px_per_m)
    reference = level_points(document, finest[0], atlases=finest[1], spacing_m=spacing, threshold=threshold)
    frame = frame_about(reference, px_per_m=px_per_m, views=VIEWS)
    wanted = _area(seen_in(frame, reference))
    low, high, found = 0.0, MOST, level
    for _ in range(STEPS):
        middle = 0.5 * (low + high)
        found = replace(level, widening=np.minimum(share**middle, share.max()))
        points = level_points(document, found, atlases=atlases, spacing_m=spacing, threshold=threshold)
        low, high = (middle, high) if _area(seen_in(frame, points)) < wanted else (low, middle)
    return found


def _area(views: Sequence[CardView]) -> float:
    return float(np.sum([view.hair.sum(dtype=np.float64) for view in views]))
