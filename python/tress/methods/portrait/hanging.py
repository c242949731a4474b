"""How far down the hidden hair hangs: as far as the hair seen at either side of the neck."""

from typing import Any

import numpy as np

from tress.methods.portrait.box import Box

Array = np.ndarray[Any, Any]

BESIDE = 0.045
"""Metres from the middle from which hair hangs at the side."""
NARROWEST = 0.008
"""Metres that hair at the side is wide at least."""
BREAK = 0.02
"""Metres without hair that end it."""
START = 0.03
"""Metres above the nape where hair that hangs must still be there."""
TURN = 0.07
"""Metres from the middle within which one side's length turns into the other's."""


def hanging_edge(hair: Array, *, nape: float, middle: float, box: Box) -> Array:
    """(C,) metres: y of the lower edge of the hidden hair in every column, from the columns of `hair` (R, C) bool.

    `nape`: y of the scalp's lower end, `middle`: x of the neck. Above the nape where hair is short: the edge then is
    where hair ends that is seen, or infinity where there is none at the side.
    """
    left, right = (_lowest(hair[:, side], nape, box) for side in (box.x < middle - BESIDE, box.x > middle + BESIDE))
    share = np.clip((box.x - middle) / (2 * TURN) + 0.5, 0, 1)
    share = share * share * (3 - 2 * share)
    ends = [nape + START if not np.isfinite(end) else end for end in (left, right)]
    return ends[0] * (1 - share) + ends[1] * share


def _lowest(hair: Array, nape: float, box: Box) -> float:
    """y of the lowest hair of one side that hangs without a break from above the nape; infinite where none does."""
    there = hair.sum(axis=1) * box.size >= NARROWEST
    if not (there & (box.y > nape)).any():
        return float("inf")
    rows = np.flatnonzero(there)
    first = np.flatnonzero(box.y[rows] > nape)[-1]
    broken = np.flatnonzero(np.diff(rows[first:]) * box.size > BREAK)
    last = rows[first + broken[0]] if len(broken) else rows[-1]
    return float(box.y[last])
