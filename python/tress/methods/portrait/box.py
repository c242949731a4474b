"""The box of voxels around head and hair, aligned with the picture: a column of voxels is a square of pixels."""

from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Box:
    """`origin` (3,) metres: corner with the least x, greatest y, least z in the view frame; `size`: edge of a voxel,
    metres.

    Voxel (layer, row, column) has its centre at `origin + size (column + ½, -(row + ½), layer + ½)`.
    """

    origin: Array
    size: float
    layers: int
    rows: int
    columns: int

    @property
    def shape(self) -> tuple[int, int, int]:
        """(layers, rows, columns)."""
        return self.layers, self.rows, self.columns

    @property
    def x(self) -> Array:
        """(columns,) metres: x of the columns' centres."""
        return self.origin[0] + self.size * (np.arange(self.columns) + 0.5)

    @property
    def y(self) -> Array:
        """(rows,) metres: y of the rows' centres, falling."""
        return self.origin[1] - self.size * (np.arange(self.rows) + 0.5)

    @property
    def z(self) -> Array:
        """(layers,) metres: z of the layers' centres."""
        return self.origin[2] + self.size * (np.arange(self.layers) + 0.5)

    def cells(self, points: Array) -> Array:
        """(N, 3) -> (N, 3): column, row, layer as real numbers, a voxel's centre at + 0.5."""
        return (points - self.origin) / self.size * np.array([1.0, -1.0, 1.0])

    def centres(self, where: Array) -> Array:
        """(N, 3) metres: the centres of the voxels where `where` (L, R, C) is true, in their order."""
        layer, row, column = np.nonzero(where)
        return np.stack([self.x[column], self.y[row], self.z[layer]], axis=1)

    def pixels(self, xy_from_view: Array) -> tuple[Array, Array]:
        """(rows, columns) each: pixel coordinates u, v of the columns' centres."""
        u = xy_from_view[0, 0] * self.x + xy_from_view[0, 3]
        v = xy_from_view[1, 1] * self.y + xy_from_view[1, 3]
        return np.broadcast_to(u, (self.rows, self.columns)), np.broadcast_to(v[:, None], (self.rows, self.columns))


def box_around(low: Array, high: Array, *, size: float) -> Box:
    """The smallest box of whole voxels that holds `low` to `high` (3,) metres."""
    counts = np.maximum(np.ceil((high - low) / size), 1).astype(int)
    return Box(np.array([low[0], high[1], low[2]]), size, int(counts[2]), int(counts[1]), int(counts[0]))
