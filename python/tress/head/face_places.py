"""Where on the head a colour that is not the skin's belongs there all the same, and where the photograph ends.

Eyes, brows, lips, stubble and beard have colours of their own and must be painted; hair that hangs over forehead and
cheeks must not. The two cannot be told apart by colour, so the place decides: around the eyes, around the mouth and on
the jaw every colour counts; but on the jaw only of a face whose chin shows a beard, and around the brows only below a
forehead that is free of hair. Distances run along the mesh's edges.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from tress.head.statistical import StatisticalHead

EYES_M, BROWS_M = (0.007, 0.014), (0.018, 0.028)
"""Distances from the eyes up to which every colour counts, and from which only the skin's does: upwards where a fringe
may hang, and else."""
BROW_LINE_M = (0.004, 0.012)
"""Height above the eyes at which brows and a fringe begin."""
LIPS_M, BEARD_M = (0.006, 0.014), (0.025, 0.045)
"""The same around the lips: always, and in a bearded face."""
WITHIN_JAW_M = (0.004, 0.018)
"""Distance from the edge of the face from which every colour counts on a bearded jaw."""
DOWN_NECK_M = (0.010, 0.035)
"""Distance from the face down to which the photograph counts on the neck, and from which it does not."""
CHIN_M, FOREHEAD_M = (0.012, 0.030), (0.030, 0.050)
"""Distances below the lips where a beard would show, and above the eyes where a fringe would."""
BEARDED, FREE = (0.3, 0.6), (0.3, 0.6)
"""Share of the chin that is no skin, and of the forehead that is, where a beard and a free forehead begin, and are
certain."""


@dataclass(frozen=True)
class FacePlaces:
    """Parts of the head, each (V,) in [0, 1]: `painted` where the photograph counts; every colour counts at `features`,
    at `beard` if there is one, and at `brows` if the forehead is free; `chin` and `forehead` (V,) bool tell that."""

    painted: NDArray[np.float64]
    features: NDArray[np.float64]
    beard: NDArray[np.float64]
    brows: NDArray[np.float64]
    chin: NDArray[np.bool_]
    forehead: NDArray[np.bool_]

    def any_color(self, skin: NDArray[np.floating], *, seen: NDArray[np.floating]) -> NDArray[np.float64]:
        """(V,) in [0, 1]: where every colour counts in a face that shows `skin` (V,), as far as it is `seen` (V,)."""
        beard = _risen(1 - _mean(skin, seen * self.chin), BEARDED)
        free = _risen(_mean(skin, seen * self.forehead), FREE)
        return np.maximum(self.features, np.maximum(beard * self.beard, free * self.brows))


@lru_cache(maxsize=2)
def face_places(head: StatisticalHead) -> FacePlaces:
    """The parts of `head`; kept, about 20 ms the first time."""
    masks, height = head.masks, head.mean[:, 1]
    pockets = (masks["inside"] > 0.5) | (np.arange(len(head.mean)) >= head.skin_count)
    face = (masks["face"] > 0.5) | pockets
    from_face = _distance(head, face)
    to_edge = _distance(head, ~face & np.isfinite(from_face))
    from_eyes, from_lips = _distance(head, masks["eyes"] > 0.5), _distance(head, masks["lips"] > 0.5)
    mouth, eyes = height[masks["lips"] > 0.5].mean(), height[masks["eyes"] > 0.5].mean()
    jaw = _risen(to_edge, WITHIN_JAW_M) * _risen(mouth - height, (-0.03, -0.01))
    painted = (1 - masks["ears"]) * (1 - _risen(mouth - height, (-0.01, 0.02)) * _risen(from_face, DOWN_NECK_M))
    around_eyes = 1 - _risen(from_eyes, BROWS_M)
    below_brows = around_eyes * (1 - _risen(height - eyes, BROW_LINE_M))
    features = np.maximum(np.maximum(1 - _risen(from_eyes, EYES_M), below_brows), 1 - _risen(from_lips, LIPS_M))
    within = masks["face"] * (1 - masks["ears"])
    return FacePlaces(
        painted=np.where(pockets, 1, painted),
        features=np.where(pockets, 1, features * within),
        beard=np.maximum(1 - _risen(from_lips, BEARD_M), jaw) * within * (height < eyes),
        brows=around_eyes * within,
        chin=_between(from_lips, CHIN_M) & (height < mouth) & face & ~pockets,
        forehead=_between(from_eyes, FOREHEAD_M) & (height > eyes) & face & ~pockets,
    )


def _mean(values: NDArray[np.floating], weight: NDArray[np.floating]) -> float:
    return float((values * weight).sum() / max(weight.sum(), 1e-9))


def _between(values: NDArray[np.floating], limits: tuple[float, float]) -> NDArray[np.bool_]:
    return (values > limits[0]) & (values < limits[1])


def _risen(values: NDArray[np.floating] | float, ramp: tuple[float, float]) -> NDArray[np.float64]:
    """0 below the ramp, 1 above, smooth between."""
    t = np.clip((values - ramp[0]) / (ramp[1] - ramp[0]), 0, 1)
    return t * t * (3 - 2 * t)


def _distance(head: StatisticalHead, start: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Along the edges of the mean head to the closest vertex of `start` (V,): (V,) metres, inf where no way leads."""
    a, b = head.triangles[:, [0, 1, 2]].ravel(), head.triangles[:, [1, 2, 0]].ravel()
    length = np.linalg.norm(head.mean[a] - head.mean[b], axis=1)
    count = len(head.mean)
    edges = coo_array((length, (a, b)), shape=(count, count)).tocsr()
    edges = edges.maximum(edges.T)
    return np.asarray(dijkstra(edges, indices=np.flatnonzero(start), min_only=True))
