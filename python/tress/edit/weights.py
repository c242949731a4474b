"""Changing the weights of control points."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.edit.selection import editable_strips
from tress.model.diff import Diff
from tress.model.document import Document


def set_weights(document: Document, *, names: Iterable[str], weights: Any, points: Any = None) -> Diff:
    """Gives control points of strips new weights: the surface is drawn towards points of great weight.

    `weights` is a number, or one for every control point (U, V); with `points` (K, 2) whole numbers (row, column), one
    for each of these, and the others stay. Raises `InputError` for weights of 0 or less, for other shapes, for points
    that a strip does not have, and where a strip is locked.
    """
    pairs = {}
    for name, before in editable_strips(document, names).items():
        after = np.array(before.weights)
        try:
            after[... if points is None else tuple(_indices(points, after.shape).T)] = weights
        except ValueError as error:
            raise InputError(f"Weights of shape {np.shape(weights)} do not fit strip {name!r}: {error}.") from error
        pairs[name] = (before, replace(before, weights=after))
    return Diff(updated=pairs)


def _indices(points: Any, shape: tuple[int, ...]) -> np.ndarray[Any, Any]:
    found = np.asarray(points)
    if found.ndim != 2 or found.shape[1] != 2 or found.dtype.kind not in "iu":
        raise InputError(f"Control points are (K, 2) whole numbers; {points!r} is not.")
    if ((found < 0) | (found >= shape)).any():
        raise InputError(f"A strip of {shape[0]} x {shape[1]} control points does not have all of {found.tolist()}.")
    return found
