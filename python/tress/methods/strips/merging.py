"""Fewer strips for the same hair: each that goes is taken over by the one that lies most like it."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.distance import cdist

Array = np.ndarray[Any, Any]

ALONG = 6


@dataclass(frozen=True, eq=False)
class Merged:
    """`kept` (K,) strips in rising order; `heir` (S,) stands for each of S strips: itself, if kept."""

    kept: Array
    heir: Array


def merged(middles: Array, *, importance: Array, kind: Array, count: int) -> Merged:
    """`count` of S strips, or one of each kind where that is more.

    `middles` (S, 6, 3) are points along the strips, `importance` (S,) the area that each shows; strips are taken over
    within their `kind` (S,) alone: those covered with one atlas in one group. Again and again the strip goes whose
    importance times the distance to its heir is least; the heir inherits the importance, so that no part of a hairdo is
    emptied. Cost: S² to begin with, S a step.
    """
    distance = sum((cdist(middles[:, row], middles[:, row]) for row in range(ALONG)), np.zeros(1)) / ALONG
    distance[kind[:, None] != kind] = np.inf
    np.fill_diagonal(distance, np.inf)
    total, heir, alive = importance.astype(np.float64).copy(), np.arange(len(kind)), np.ones(len(kind), bool)
    nearest = distance.argmin(axis=1)
    least = distance[np.arange(len(kind)), nearest]
    for _ in range(max(len(kind) - count, 0)):
        cost = np.where(alive, total * least, np.inf)
        gone = int(np.argmin(cost))
        if not np.isfinite(cost[gone]):
            break
        alive[gone] = False
        heir[gone] = nearest[gone]
        total[nearest[gone]] += total[gone]
        distance[:, gone] = np.inf
        for orphan in np.flatnonzero(alive & (nearest == gone)):
            nearest[orphan] = distance[orphan].argmin()
            least[orphan] = distance[orphan, nearest[orphan]]
    while not alive[heir].all():
        heir = heir[heir]
    return Merged(np.flatnonzero(alive), heir)
