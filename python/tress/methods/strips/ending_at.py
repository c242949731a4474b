"""Hair cut to one line: how long strips must be that all end at one height."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from tress.methods.strips.even_roots import EvenRoots

Array = np.ndarray[Any, Any]

BAND_M = 0.02
OVER_M = 0.05
"""The way over the top of the head, that hair from the crown has before it falls."""


def bands_ending_at(roots: EvenRoots, y_m: float) -> Iterator[tuple[EvenRoots, float]]:
    """The roots in bands of 2 cm of height, and the length in metres with which hair from there ends at `y_m`."""
    height = roots.points[:, 1]
    band = np.floor(height / BAND_M).astype(np.int64)
    for number in np.unique(band):
        middle = (number + 0.5) * BAND_M
        over = np.clip((middle - 0.03) / 0.07, 0, 1) ** 2 * OVER_M
        yield roots.where(band == number), float(max(middle - y_m, BAND_M) + over)
