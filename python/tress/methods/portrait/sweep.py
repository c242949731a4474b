"""Where hidden hair wants to go: down, and where it does not hang, along the hairline of the face and over the ear.

Hair that falls straight down from the temples ends as a fringe over the face. Where the photograph shows none hanging,
it is combed or grown backwards there: what would lead it over the hairline in front is taken off its way, and it leans
back, the more the nearer that hairline is.
"""

from typing import Any

import numpy as np

from tress.kernel import fields
from tress.methods.portrait.box import Box
from tress.methods.portrait.scalp_layer import BEARING, Skin

Array = np.ndarray[Any, Any]

REACH = 0.05
"""Metres from the hairline of the face within which hair is swept back."""
LEAN = 0.8
"""How much backwards for one down, at that hairline."""
AHEAD = 0.2
"""Cosine between the way to the hairline and the front from which it is that of the face."""

BEHIND = 0.09
"""Metres behind the head's centre by which the hairline is that of the middle of the nape."""


def swept(skin: Skin, inside: Array, short: Array, *, backward: Array, box: Box) -> Array:
    """(N, 3) where hair wants to go at the voxels `inside` (L, R, C); `short` (C,): columns where none hangs.

    `backward` (3,): the unit direction from the face to the back of the head.
    """
    down = np.array([0.0, -1.0, 0.0])
    outward, distance = _to_hairline(skin, box)
    ahead = np.clip(-(outward @ backward) / AHEAD, 0, 1) * np.clip(1 - (skin.centres @ backward) / BEHIND, 0, 1)
    near = ahead * np.clip(1 - distance / REACH, 0, 1)
    wish = down + (LEAN * near)[:, None] * backward
    over = np.maximum((wish * outward).sum(axis=1), 0) * np.sqrt(near)
    wish = wish - over[:, None] * outward
    column = np.nonzero(inside)[2]
    return np.where(short[column][:, None], wish[skin.nearest[inside]], down)


def _to_hairline(skin: Skin, box: Box) -> tuple[Array, Array]:
    """Of every voxel of the skin, the unit way (N, 3) to the nearest that bears no hair, and how far it is, metres."""
    marks = np.zeros(box.shape, np.bool_)
    marks.ravel()[skin.cells[skin.bearing <= BEARING]] = True
    nearest = fields.nearest(marks)
    place = np.stack(np.unravel_index(nearest.cell.ravel()[skin.cells], box.shape), axis=1) + 0.5
    there = box.origin + box.size * place[:, ::-1] * [1, -1, 1]
    way = there - skin.centres
    length = np.linalg.norm(way, axis=1)
    return way / np.maximum(length, 1e-9)[:, None], length
