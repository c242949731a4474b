"""Control points of many strips moved at once: what displacing, layering and pushing out come down to."""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.model.diff import Diff
from tress.model.strip_set import StripSet

Array = np.ndarray[Any, Any]


def moved(strips: StripSet, shift_in_head: Array) -> Diff:
    """The change that moves the control points of a strip set by (N, 3) metres along the axes of the head frame.

    Points that do not move keep their bits; strips that do not move are not in the change.
    """
    nets = strips.nets(strips.points + strips.frames.vectors_in_root(shift_in_head, strip=strips.strip))
    pairs = {}
    for name, record, net in zip(strips.names, strips.records, nets, strict=True):
        if not np.array_equal(net, record.points):
            pairs[name] = (record, replace(record, points=net))
    return Diff(updated=pairs)
