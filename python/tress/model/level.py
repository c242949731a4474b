"""Levels of detail: the same surfaces with fewer strips, wider ones, and fewer polygons."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse import csr_array, diags_array

from tress.base.errors import InputError
from tress.model.document import Document
from tress.model.strip import Strip
from tress.model.strip_grid import StripGrid, even_strip_grid
from tress.model.strip_set import StripSet, strip_set

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Level:
    """What a level shows: S strips of a document in alphabetical order, in how many polygons, and how much widened.

    `segments` (S, 2) int64 are intervals of the domains along and across; `widening` (S,) float64 the factor on the
    widths, 1 for a strip as it is. `rows` says for each strip where it is divided along, (segments + 1,) float64 shares
    of the domain that rise from 0 to 1; without them, and across, intervals are equal. Nothing else differs between
    levels: surfaces, texture coordinates, roots and keyframes are those of the document. Raises `InputError` for other
    shapes, for numbers that are not positive, and for rows that do not rise.
    """

    names: tuple[str, ...]
    segments: Array
    widening: Array
    rows: tuple[Array, ...] = ()

    def __post_init__(self) -> None:
        count = len(self.names)
        if self.segments.shape != (count, 2) or self.widening.shape != (count,):
            raise InputError(f"A level of {count} strips has segments {self.segments.shape}, {self.widening.shape}.")
        if count and (self.segments.min() < 1 or not self.widening.min() > 0):
            raise InputError("A level has a strip without polygons or width; positive numbers were expected.")

        if self.rows and len(self.rows) != count:
            raise InputError(f"A level of {count} strips has rows for {len(self.rows)}.")
        for name, rows, along in zip(self.names, self.rows, self.segments[:, 0], strict=False):
            if rows.shape != (along + 1,) or not (np.diff(rows) > 0).all() or rows[0] != 0 or rows[-1] != 1:
                raise InputError(f"A level divides {name!r} at {rows}; {along + 1} numbers from 0 to 1 were expected.")

    def part(self, index: Array) -> "Level":
        """The level with those strips alone whose place is in `index` (K,)."""
        rows = tuple(self.rows[place] for place in index) if self.rows else ()
        names = tuple(self.names[place] for place in index)
        return Level(names, self.segments[index], self.widening[index], rows)

    @property
    def triangles(self) -> int:
        """How many triangles the level has at most: two a polygon, and one where a side of a strip is a point."""
        return int(2 * self.segments.prod(axis=1).sum())


@dataclass(frozen=True, eq=False)
class LevelSurface:
    """A level ready to be posed: `grid.points(posed_points(strips, time))` are its vertices at a time."""

    strips: StripSet
    grid: StripGrid


def level_surface(document: Document, level: Level) -> LevelSurface:
    """The strips of a level and the grid over them, widening included, so that it holds in every pose.

    Triangles without area at rest (where a strip ends in a point) are left out.
    """
    strips = strip_set(document, level.names)
    grid = even_strip_grid(strips.records, segments=level.segments, rows=level.rows)
    widened = replace(grid, weights=csr_array(grid.weights @ widening_matrix(strips.records, level.widening)))
    return LevelSurface(strips, replace(widened, triangles=_with_area(widened, strips)))


def widening_matrix(strips: Sequence[Strip], factors: Array) -> csr_array:
    """(N, N) sparse: control points of S strips moved away from the mean of their row by `factors` (S,).

    A row is what lies across the hair, so lengths and the line through the middle of a strip stay.
    """
    shapes = np.array([strip.weights.shape for strip in strips], np.int64).reshape(-1, 2)
    columns = np.repeat(shapes[:, 1], shapes[:, 0])
    of_row = np.repeat(factors, shapes[:, 0])
    factor = np.repeat(of_row, columns)
    row = np.repeat(np.arange(len(columns)), columns)
    total = len(row)
    in_row = csr_array((np.ones(total), row, np.arange(total + 1)), shape=(total, len(columns)))
    mean = in_row @ diags_array((1 - of_row) / columns) @ in_row.T
    return csr_array(diags_array(factor) + mean)


def _with_area(grid: StripGrid, strips: StripSet) -> Array:
    points = grid.points(strips.points)
    a, b, c = (points[grid.triangles[:, corner]] for corner in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    longest = np.max([np.linalg.norm(side, axis=1) for side in (b - a, c - b, a - c)], axis=0)
    return grid.triangles[area > 1e-9 * longest**2]
