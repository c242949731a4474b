"""How far every part of a strip may move: what lies on the scalp keeps still, what hangs swings."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from tress.kernel.geom import closest_points
from tress.model.document import Document
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.strip_set import posed_points, strip_set

Array = np.ndarray[Any, Any]

ROWS = 8
"""Displacements along a strip, stretched over as many rows as it has."""
LIES_M, HANGS_M = 0.012, 0.035
"""So near the scalp hair lies on it; so far from it, it hangs."""
LEAST_M = 0.08
"""Strips of which less hangs move less, as they are short there."""
HALF = 0.5


def hanging_growth(document: Document, names: Iterable[str], *, stiffness: float) -> dict[str, Array]:
    """For every strip rooted on a head with a scalp the shares (ROWS,) of its tip's swing, from root to tip, in [0, 1].

    A share is the length of hair from the root on that hangs, over that of the whole strip, to the power `stiffness`:
    0 wherever the strip has not left the scalp yet. A strip that leaves it for less than `LEAST_M` swings less.
    """
    found: dict[str, Array] = {}
    chosen = tuple(names)
    if not chosen:
        return found
    strips = strip_set(document, chosen)
    nets = strips.nets(posed_points(strips))
    on: dict[str, list[int]] = {}
    for index, strip in enumerate(strips.records):
        on.setdefault("" if strip.root is None else strip.root.surface, []).append(index)
    for surface, members in on.items():
        scalp = _scalp(document, surface)
        if scalp is None:
            continue
        middles = np.stack([_middle(nets[index]) for index in members])
        growth = _growth(scalp, middles, stiffness)
        found |= {strips.names[index]: growth[row] for row, index in enumerate(members)}
    return found


def _scalp(document: Document, surface: str) -> Mesh | None:
    """The part of a head that hair grows on; None where the record is none, or does not know it."""
    head = document.records.get(surface)
    if not isinstance(head, Head) or "scalp" not in head.mesh.vertex_attributes:
        return None
    hairy = (head.mesh.vertex_attributes["scalp"][head.mesh.triangles] > HALF).all(axis=1)
    return Mesh(positions=head.mesh.positions, triangles=head.mesh.triangles[hairy]) if hairy.any() else None


def _middle(net: Array) -> Array:
    """(ROWS, 3) places along the middle of a net (U, V, 3)."""
    rows = net.mean(axis=1)
    at = np.linspace(0, len(rows) - 1, ROWS)
    return np.stack([np.interp(at, np.arange(len(rows)), rows[:, axis]) for axis in range(3)], axis=1)


def _growth(scalp: Mesh, middles: Array, stiffness: float) -> Array:
    queries = middles.reshape(-1, 3)
    near = closest_points(scalp.positions, triangles=scalp.triangles, queries=queries).distance.reshape(
        len(middles), -1
    )
    share = np.clip((np.abs(near) - LIES_M) / (HANGS_M - LIES_M), 0, 1)
    free = share * share * (3 - 2 * share)
    steps = np.linalg.norm(np.diff(middles, axis=1), axis=2) * 0.5 * (free[:, 1:] + free[:, :-1])
    hanging = np.concatenate([np.zeros((len(middles), 1)), np.cumsum(steps, axis=1)], axis=1)
    return (hanging / np.maximum(hanging[:, -1:], LEAST_M)) ** stiffness
