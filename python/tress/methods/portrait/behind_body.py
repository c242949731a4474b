"""How far in front hidden hair may be: behind the head and the neck, over the bust, behind the shoulders.

The mesh of the head ends in a bust; of the body below and beside it only the outline in the photograph is known.
"""

from typing import Any

import numpy as np
from scipy.ndimage import minimum_filter

from tress.methods.portrait.box import Box
from tress.methods.portrait.envelope import Envelope, SolidHead

Array = np.ndarray[Any, Any]

BODY_GAP = 0.01
"""Metres between the back of the neck and hair behind the body."""
BUST_GAP = 0.004
"""Metres between the back of the bust and hair that falls over it."""
ROUND_BUST = 7
"""Columns and rows over which the bust's back is taken at its rearmost."""
SWING = 0.6
"""Slope with which hair swings back over the bust."""
NECK = 0.05
"""Metres below the nape over which the neck is trusted."""


def behind_head(head: SolidHead, box: Box) -> Array:
    """(R, C) metres: the foremost that hidden hair may be: the head's back; below the nape, the back of the neck.

    The bust that ends the head's mesh says nothing of the body: its open columns have no back. Hair that falls from
    above passes behind what of it stands out further.
    """
    neck = head.back[(box.y < head.nape) & (box.y > head.nape - NECK)]
    behind = float(np.nanmin(neck)) - BODY_GAP if np.isfinite(neck).any() else 0.0
    above = head.seen & (box.y >= head.nape - NECK)[:, None]
    return np.where(above, head.back, np.minimum(over_bust(head, box), behind))


def behind_shoulders(surface: Envelope, front: Array) -> Array:
    """(R, C) metres: the foremost of hair that a shoulder hides: where it meets it, then back by and by."""
    falls = surface.extended & ~surface.hair & ~surface.head.seen
    foremost = np.where(surface.hair, front, -np.inf)
    for row in range(1, len(foremost)):
        foremost[row] = np.where(falls[row], foremost[row - 1] - SWING * surface.box.size, foremost[row])
    return np.where(falls, foremost, -np.inf)


def over_bust(head: SolidHead, box: Box) -> Array:
    """(R, C) metres: the foremost of hair that falls over the back of neck and bust; far before both where it does
    not touch them. Above where it touches it swings back by and by.
    """
    below = (box.y < head.nape)[:, None]
    rearmost = minimum_filter(np.where(below & head.seen, head.back, np.inf), size=ROUND_BUST)
    over = np.minimum.accumulate(rearmost, axis=0) - BUST_GAP
    for row in range(len(over) - 2, -1, -1):
        over[row] = np.minimum(over[row], over[row + 1] + SWING * box.size)
    return over
