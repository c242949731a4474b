"""Where the cards of an atlas lie: a grid of equal cells, each a card with an empty border.

Cells begin and end at multiples of `block`, a power of two not above twice the padding. So down to the level where a
texel is a block, no texel of the mip chain holds parts of two cells, and bilinear lookups inside a card, which reach
half a texel beyond it, stay within its own cell.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import ParameterError

Array = np.ndarray[Any, Any]

_LEAST_CARD_PX = 8
_HIGHEST_PX = 8192
_TALL = 0.3
"""How much one doubling of the height beyond the width counts, where 1 is an aspect wrong by a factor of e."""


@dataclass(frozen=True)
class Layout:
    """An atlas of `width` x `height` px with `columns` x `rows` cells; cards leave `padding` px free in their cells."""

    width: int
    height: int
    columns: int
    rows: int
    cell_width: int
    cell_height: int
    padding: int
    count: int

    @property
    def card_width(self) -> int:
        """Pixels across a card."""
        return self.cell_width - 2 * self.padding

    @property
    def card_height(self) -> int:
        """Pixels along a card."""
        return self.cell_height - 2 * self.padding

    @property
    def least_side(self) -> int:
        """Pixels of the card's shorter side, 0 or less where padding leaves none."""
        return min(self.card_width, self.card_height)

    @property
    def aspect(self) -> float:
        """Length of a card over its width."""
        return self.card_height / self.card_width

    @property
    def regions(self) -> Array:
        """(count, 4) float64: u low, v low, u high, v high of every card, v up."""
        card, size = np.arange(self.count), np.array([self.width, self.height])
        corner = np.stack([card % self.columns * self.cell_width, card // self.columns * self.cell_height], axis=1)
        upper_left = (corner + self.padding) / size
        lower_right = (corner + [self.cell_width - self.padding, self.cell_height - self.padding]) / size
        return np.stack([upper_left[:, 0], 1 - lower_right[:, 1], lower_right[:, 0], 1 - upper_left[:, 1]], axis=1)

    def cell(self, card: int) -> tuple[slice, slice]:
        """Rows and columns of the picture that belong to a card with its border."""
        row, column = divmod(card, self.columns)
        return (
            slice(row * self.cell_height, (row + 1) * self.cell_height),
            slice(column * self.cell_width, (column + 1) * self.cell_width),
        )


def card_layout(count: int, *, width: int, aspect: float, padding: int) -> Layout:
    """The grid for `count` cards in an atlas of `width` px (a power of two) whose cards are nearest to `aspect`.

    The height is a quarter of the width to four times it, at most 8192 px. Empty cells count as much as a wrong aspect
    does, and atlases taller than wide need a reason.
    Raises `ParameterError` where a card would be less than 8 px wide or long.
    """
    block = 2 ** int(math.log2(2 * padding))
    tried = [
        _grid(count, columns, width, height, block, padding)
        for height in (width // 4, width // 2, width, 2 * width, 4 * width)
        for columns in range(1, count + 1)
    ]
    fitting = [one for one in tried if one.height <= _HIGHEST_PX and one.least_side >= _LEAST_CARD_PX]
    if not fitting:
        raise ParameterError(
            f"{count} variations with {padding} px of padding do not fit into {width} px; "
            "raise the resolution or lower the padding."
        )
    return min(fitting, key=lambda one: abs(math.log(one.aspect / aspect)) + math.log(_waste(one)) + _tallness(one))


def _grid(count: int, columns: int, width: int, height: int, block: int, padding: int) -> Layout:
    rows = -(-count // columns)
    cell_width, cell_height = (side // parts // block * block for side, parts in ((width, columns), (height, rows)))
    return Layout(width, height, columns, rows, cell_width, cell_height, padding, count)


def _waste(layout: Layout) -> float:
    """Pixels of the atlas over pixels of its cells."""
    return layout.width * layout.height / (layout.count * layout.cell_width * layout.cell_height)


def _tallness(layout: Layout) -> float:
    return _TALL * max(math.log2(layout.height / layout.width), 0)
