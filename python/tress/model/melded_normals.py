"""Normals of hair as one body: those of single clumps, drawn towards those of a round shape around the head.

Clumps that lie on one another then have nearly the same normals and so the same tone: they meld, as drawn hair does.
"""

from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


def body_normals(positions: Array, *, centre: Array) -> Array:
    """(V, 3) unit normals of a ball about `centre` (3,) that goes on downwards as an upright tube."""
    outwards = np.asarray(positions, np.float64) - centre
    outwards[:, 1] = np.maximum(outwards[:, 1], 0)
    return _unit(outwards)


def melded(normals: Array, body: Array, *, share: float) -> Array:
    """(V, 3) unit normals: `share` 0 are those of the clumps, 1 those of the body."""
    return _unit((1 - share) * normals + share * body)


def _unit(vectors: Array) -> Array:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True).clip(1e-9)
