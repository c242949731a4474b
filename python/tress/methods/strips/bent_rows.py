"""Where to divide a strip along, so that few polygons follow it closely."""

from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

EVEN = 0.25
"""How much of the rows is spread evenly along the length, for poses that bend elsewhere than the one at rest."""


def bent_rows(line: Array, pieces: int) -> Array:
    """(pieces + 1,) float64 shares of the domain, from 0 to 1, for a line with points (R, 3) at even parameters.

    A chord of length h errs by curvature times h² / 8, so that all err alike where rows are as dense as the root of the
    curvature. A line without length is divided evenly.
    """
    steps = np.diff(line, axis=0)
    length = np.linalg.norm(steps, axis=1)
    even = np.linspace(0, 1, pieces + 1)
    if pieces == 1 or length.sum() <= 0:
        return even
    unit = steps / np.maximum(length, 1e-300)[:, None]
    turn = np.zeros(len(line))
    turn[1:-1] = np.arccos(np.clip((unit[1:] * unit[:-1]).sum(axis=1), -1, 1))
    root = np.sqrt(0.5 * (turn[1:] + turn[:-1]) * length)
    density = EVEN * length / length.sum() + (1 - EVEN) * root / max(root.sum(), 1e-300)
    total = np.concatenate([[0.0], np.cumsum(density + 1e-6 / len(density))])
    found = np.interp(even, total / total[-1], np.linspace(0, 1, len(total)))
    return np.concatenate([[0.0], found[1:-1], [1.0]])
