"""Hidden hair kept off the skin that the photograph shows.

Voxels of some millimetres do not end where the hairline does, so hidden strands before the head would lie as a dark
line along it, over forehead and temples.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.image.labels import FACE
from tress.kernel import fields
from tress.methods.portrait.envelope import Head

Array = np.ndarray[Any, Any]

MOST_ALPHA = 0.5
"""Hair up to which skin counts as bare."""
BEHIND_SURFACE = 0.003
"""Metres behind the head's surface from which on the head hides a point."""


def bare_skin(alpha: Array, label: Array) -> Array:
    """(H, W) bool: skin with little hair before it, from the matte's `alpha` and the layers' `label` (H, W)."""
    return (label == FACE) & (alpha < MOST_ALPHA)


def off_bare_skin(hidden: fields.Traced, *, skin: Array, head: Head) -> fields.Traced:
    """The strands without what lies before bare `skin` (H, W): of each its longest part, if that has two points."""
    matrix = head.xy_from_view
    height, width = skin.shape
    pixel = hidden.points[:, :2] * [matrix[0, 0], matrix[1, 1]] + matrix[:2, 3]
    column, row = (np.clip(pixel[:, axis].astype(np.int64), 0, side - 1) for axis, side in ((0, width), (1, height)))
    vertices = head.positions_in_view
    flat = vertices[:, :2] * [matrix[0, 0], matrix[1, 1]] + matrix[:2, 3]
    depth = fields.mesh_depth(np.column_stack([flat, vertices[:, 2]]), head.triangles, shape=skin.shape)
    covering = skin[row, column] & (hidden.points[:, 2] > depth.front[row, column] - BEHIND_SURFACE)
    return _longest_parts(hidden, ~covering) if covering.any() else hidden


def _longest_parts(traced: fields.Traced, good: Array) -> fields.Traced:
    """Of every strand the longest run of `good` points (N,); strands without a run of two go."""
    strand = np.repeat(np.arange(len(traced.offsets) - 1), np.diff(traced.offsets))
    begins = good & np.r_[True, ~good[:-1] | (strand[1:] != strand[:-1])]
    run = np.cumsum(begins) - 1
    length = np.bincount(run[good], minlength=int(begins.sum()))
    owner = strand[begins]
    order = np.lexsort((np.arange(len(owner)), -length, owner))
    first = order[np.r_[True, owner[order][1:] != owner[order][:-1]]] if len(order) else order
    chosen = np.zeros(len(length), np.bool_)
    chosen[first] = length[first] >= 2
    kept = good & chosen[np.maximum(run, 0)] if len(chosen) else good
    count = np.bincount(strand[kept], minlength=len(traced.offsets) - 1)
    stays = count > 0
    whole = traced.rooted & (kept[traced.offsets[:-1]] & stays)
    return replace(
        traced,
        points=traced.points[kept],
        offsets=np.concatenate([[0], np.cumsum(count[stays])]),
        seed=traced.seed[stays],
        rooted=whole[stays],
    )
