"""Operations on strands as flat arrays: strand i is `points[offsets[i]:offsets[i + 1]]`, at least two, root to tip.

Every function raises `InputError` for wrong shapes, numbers that are not finite and offsets that do not rise by at
least two from 0 to the number of points.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Sampling:
    """Where new points lie between old ones: `fraction` (M,) from old point `index` (M,) to the one after it.

    `offsets` (S + 1,) int64 are those of the new points.
    """

    offsets: Array
    index: Array
    fraction: Array

    def values(self, per_point: Array) -> Array:
        """An attribute (N, ...) of the old points at the new ones: (M, ...), of the old dtype, linear in between.

        Whole numbers and booleans are taken from the nearer old point.
        """
        old = np.asarray(per_point)
        if old.dtype.kind != "f":
            return old[self.index + (self.fraction >= 0.5)]
        part = self.fraction.reshape(-1, *(1,) * (old.ndim - 1)).astype(old.dtype)
        return old[self.index] * (1 - part) + old[self.index + 1] * part


def lengths(points: Array, *, offsets: Array) -> Array:
    """(S,) float64: length of every strand, in the unit of the points.

    >>> lengths([[0, 0, 0], [3, 4, 0], [3, 4, 2]], offsets=[0, 3]).tolist()
    [7.0]
    """
    return _answer(_core.strands_lengths, points, offsets)


def arc_lengths(points: Array, *, offsets: Array) -> Array:
    """(N,) float64: length from the root to every point; 0 at roots."""
    return _answer(_core.strands_arc_lengths, points, offsets)


def resample_by_count(points: Array, *, offsets: Array, count: int) -> Sampling:
    """`count` points (at least 2) on every strand, at equal lengths along it; roots and tips stay where they are.

    >>> points = np.array([[0.0, 0, 0], [1, 0, 0], [4, 0, 0]])
    >>> resample_by_count(points, offsets=[0, 3], count=5).values(points)[:, 0].tolist()
    [0.0, 1.0, 2.0, 3.0, 4.0]
    """
    if count < 2:
        raise InputError(f"count is {count}; at least 2 points were expected.")
    return Sampling(*_answer(_core.strands_resample_by_count, points, offsets, int(count)))


def resample_by_spacing(points: Array, *, offsets: Array, spacing: float) -> Sampling:
    """Points at equal lengths of at most `spacing` (in the unit of the points), as few as that allows; ends stay."""
    if not spacing > 0:
        raise InputError(f"spacing is {spacing}; a positive number was expected.")
    return Sampling(*_answer(_core.strands_resample_by_spacing, points, offsets, float(spacing)))


def smooth(points: Array, *, offsets: Array, amount: float) -> Array:
    """(N, 3) float64: points drawn towards the middle of their neighbours; roots and tips stay.

    Features shorter than about 2 pi sqrt(`amount`) points fade; 0 changes nothing. Implicit, so every amount is stable.
    """
    if not 0 <= amount < np.inf:
        raise InputError(f"amount is {amount}; a number not below 0 was expected.")
    return _answer(_core.strands_smooth, points, offsets, float(amount))


def transformed(points: Array, *, transform: Array) -> Array:
    """(N, 3) float32: points under an affine `transform` (4, 4) with last row 0 0 0 1, which maps columns.

    Computed in double precision from single, rounded once.
    """
    matrix = checked(transform, name="transform", dtype=np.float64, shape=(4, 4))
    if not np.array_equal(matrix[3], (0, 0, 0, 1)):
        raise InputError(f"transform has last row {matrix[3]}; 0 0 0 1 was expected.")
    return _core.strands_transformed(checked(points, name="points", dtype=np.float32, shape=(None, 3)), matrix)


def _answer(function: Any, points: Array, offsets: Array, *rest: Any) -> Any:
    flat = checked(points, name="points", dtype=np.float64, shape=(None, 3))
    starts = checked(offsets, name="offsets", dtype=np.int64, shape=(None,))
    try:
        return function(flat, starts, *rest)
    except ValueError as error:
        raise InputError(f"The strands cannot be used: {error}.") from error
