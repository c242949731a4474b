"""The directions of a strip itself, from the shape of its control net."""

from typing import Any

import numpy as np

from tress.base.errors import InputError

Array = np.ndarray[Any, Any]

SHORTEST_M = 1e-9


def strip_axes(net: Array) -> Array:
    """(3, 3) float64 with unit columns: along the hair at the root, across it, and the normal x × y.

    Across is exact, from the first to the last column of the root row, made perpendicular to along. Where that row is a
    point, as in a strip that tapers to its root, the next row that is wide says it.
    Raises `InputError` where the net (U, V, 3) has no length, or no width beside it.

    >>> rows, columns = np.meshgrid([0.0, 1.0], [0.0, 1.0], indexing="ij")
    >>> strip_axes(np.stack([rows, columns, 0 * rows], axis=-1)).tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    centres = net.mean(axis=1)
    along = _first_long(centres[1:] - centres[0])
    if along is None:
        raise InputError("A strip has no length: all rows of its control points have one centre.")
    widths = net[:, -1] - net[:, 0]
    across = _first_long(widths - (widths @ along)[:, None] * along)
    if across is None:
        raise InputError("A strip has no width: its columns of control points coincide.")
    return np.stack([along, across, np.cross(along, across)], axis=1)


def _first_long(vectors: Array) -> Array | None:
    """The first vector that has a length, made 1 long."""
    lengths = np.linalg.norm(vectors, axis=1)
    if not (lengths > SHORTEST_M).any():
        return None
    chosen = int(np.argmax(lengths > SHORTEST_M))
    return vectors[chosen] / lengths[chosen]
