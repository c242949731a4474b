"""How thick hair lies on every part of the scalp: seen at the outline, continued over what the photograph hides.

The skin of the head is a shell of voxels. Hair grows where the head's scalp mask says, except where the photograph
shows skin (a high forehead, a bald patch, shaved sides), and a little beyond what it shows of that. Its thickness is
known where the outline of the hair passes the skull, spreads harmonically over the shell, and thins out towards the
hairline of the hidden side, which is the scalp mask's own. Where no outline is near, hair is as thick as that seen at
the same height: a cut that is shorter at the ears is so at the nape.

Limits: what is bare on the hidden side only is not known.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import KDTree

from tress.kernel import fields
from tress.methods.portrait.box import Box

Array = np.ndarray[Any, Any]

SKIN_VOXELS = 1.5
"""Thickness of the shell of voxels that stands for the skin; whole enough that values spread along it."""
BEARING = 0.4
"""Weight in the scalp mask from which hair grows."""
BARE_REACH = 0.010
"""Metres over which bareness that is seen goes on where nothing is seen."""
SEEN_DEPTH = 2.5
"""Voxels behind the head's front within which skin shows."""
TAPER = 0.03
"""Metres from the hidden hairline over which hair gets its full thickness."""
LEAST = 0.004
"""Metres of the thinnest layer."""
ALIKE = 0.02
"""Weight with which hidden hair is as thick as what is seen at its height: what is seen reaches some 7 voxels."""
HEIGHTS = 12
"""Heights at which the thickness is told apart."""


@dataclass(frozen=True)
class Skin:
    """The head's skin as voxels: `cells` (N,) numbers in the flattened box, their `centres` (N, 3) metres and weight
    in the scalp mask `bearing` (N,) in [0, 1]. `nearest` (L, R, C) int32: which of the N is nearest to a voxel.
    """

    cells: Array
    centres: Array
    bearing: Array
    nearest: Array


def skin_of_head(inside: Array, positions: Array, scalp: Array, box: Box) -> Skin:
    """The skin of the head that fills the voxels `inside`, its mask `scalp` (V,) given at `positions` (V, 3)."""
    shell = np.logical_and(inside, fields.distance(~inside) <= SKIN_VOXELS)
    centres = box.centres(shell)
    number = np.cumsum(shell.ravel(), dtype=np.int32) - 1
    distance, near = KDTree(positions).query(centres, k=3)
    share = 1 / np.maximum(distance, 1e-4)
    bearing = (scalp[near] * share).sum(axis=1) / share.sum(axis=1)
    return Skin(np.flatnonzero(shell), centres, bearing, number[fields.nearest(shell).cell])


def scalp_thickness(
    skin: Skin, *, front: Array, hair: Array, bare: Array, outline: Array, nearest: Array, gap: Array, box: Box
) -> Array:
    """(N,) float64 metres: thickness of the hair on each voxel of the skin, 0 where none grows.

    Per column (R, C): `front` of the head, NaN beside it, in metres; whether the photo shows `hair` or `bare` skin
    there; the hair's `outline`, the depth `nearest` to the head in it, metres, and the `gap` to the head there.
    """
    cover = _cover(skin, front, hair, bare, box)
    grows = (skin.bearing > BEARING) & (cover > 0.5)
    if not grows.any():
        return np.zeros(len(cover))
    thickness = _spread_thickness(skin, outline, nearest, gap, box)
    hidden_edge = skin.bearing <= BEARING
    inward = _distance_to(skin, hidden_edge, box)[grows] / TAPER
    share = np.clip(inward, 0, 1)
    found = np.zeros(len(cover))
    found[grows] = np.maximum(thickness[grows] * share * (2 - share), LEAST)
    return found


def _cover(skin: Skin, front: Array, hair: Array, bare: Array, box: Box) -> Array:
    """(N,): 1 where there is hair, 0 where there is none, in between where bareness goes on unseen."""
    row, column = _columns(skin, box)
    seen = skin.centres[:, 2] >= np.nan_to_num(front[row, column], nan=np.inf) - SEEN_DEPTH * box.size
    shown_bare = seen & bare[row, column]
    weight = np.where(seen & (bare | hair)[row, column], 1.0, (box.size / BARE_REACH) ** 2)
    return _on_shell(skin, np.where(shown_bare, 0.0, 1.0), weight, box)


def _spread_thickness(skin: Skin, outline: Array, nearest: Array, gap: Array, box: Box) -> Array:
    """(N,) metres: the gaps between outline and skull, continued over the skin."""
    row, column = np.nonzero(outline)
    layer = np.clip((nearest[outline] - box.origin[2]) / box.size, 0, box.layers - 1).astype(int)
    at = skin.nearest[layer, row, column]
    on_scalp = skin.bearing[at] > BEARING
    at, seen = at[on_scalp], gap[outline][on_scalp]
    total, count = (np.bincount(at, weights=w, minlength=len(skin.cells)) for w in (seen, np.ones(len(at))))
    alike = _at_height(skin.centres[:, 1], skin.centres[at, 1], seen)
    value = np.where(count > 0, total / np.maximum(count, 1), alike)
    return _on_shell(skin, value, np.where(count > 0, 1.0, ALIKE), box)


def _at_height(heights: Array, seen_at: Array, seen: Array) -> Array:
    """(N,) metres: median of the thickness `seen` (K,) near the same height, above and below that of the last."""
    if len(seen) == 0:
        return np.full(len(heights), LEAST)
    order = np.argsort(seen_at, kind="stable")
    parts = [part for part in np.array_split(order, HEIGHTS) if len(part)]
    middles = [float(np.median(seen_at[part])) for part in parts]
    return np.interp(heights, middles, [float(np.median(seen[part])) for part in parts])


def _on_shell(skin: Skin, values: Array, weights: Array, box: Box) -> Array:
    """(N,): the smoothest values over the skin near those given."""
    mask, given, held = np.zeros(box.shape, np.bool_), np.zeros(box.shape), np.zeros(box.shape)
    for field, filling in ((mask, True), (given, values), (held, weights)):
        field.ravel()[skin.cells] = filling
    found = fields.diffuse(given, mask=mask, weights=held, accuracy=1e-3, max_iterations=300).values
    return found.ravel()[skin.cells]


def _distance_to(skin: Skin, chosen: Array, box: Box) -> Array:
    """(N,) metres: how far each voxel of the skin is from those chosen."""
    marks = np.zeros(box.shape, np.bool_)
    marks.ravel()[skin.cells[chosen]] = True
    return fields.distance(marks).ravel()[skin.cells] * box.size


def _columns(skin: Skin, box: Box) -> tuple[Array, Array]:
    """Row and column (N,) of every voxel of the skin."""
    return (skin.cells // box.columns) % box.rows, skin.cells % box.columns
