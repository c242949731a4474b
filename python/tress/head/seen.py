"""How well the camera sees each vertex of the fitted head."""

import numpy as np
from numpy.typing import NDArray

from tress.head.fit import FittedHead
from tress.head.scalp import vertex_normals
from tress.head.statistical import StatisticalHead
from tress.kernel.geom import rays_blocked

FACING = (0.25, 0.6)
"""Cosine between normal and camera at which a vertex begins to count, and counts fully."""
POCKET_SHARE = 0.5
"""Share of its rim that must be seen for a pocket to count fully."""
LIFT_M = 5e-4
"""How far from the surface a ray to the camera starts."""


def seen_by_camera(fitted: FittedHead, *, head: StatisticalHead) -> NDArray[np.float64]:
    """(V,) in [0, 1]: 1 where a vertex faces the camera and nothing of the head is before it or its neighbours.

    Mouth bag, eye sockets and eyeballs count as their lips and lids do on that side, on the whole: so teeth and eyes
    are painted where they show, and what is hidden now looks like its surroundings when the head turns.
    """
    positions = fitted.positions_in_view
    normals = vertex_normals(positions, triangles=fitted.triangles)
    toward = np.broadcast_to([0.0, 0.0, 1.0], positions.shape)
    origins = positions + LIFT_M * (normals + toward)
    hidden = np.asarray(rays_blocked(positions, triangles=fitted.triangles, origins=origins, directions=toward), bool)
    t = np.clip((normals[:, 2] - FACING[0]) / (FACING[1] - FACING[0]), 0, 1)
    return _pockets_like_rims(t * t * (3 - 2 * t) * ~hidden, head)


def _pockets_like_rims(seen: NDArray[np.float64], head: StatisticalHead) -> NDArray[np.float64]:
    masks, side = head.masks, head.mean[:, 0] > 0
    skin = np.arange(len(side)) < head.skin_count
    pockets = (masks["inside"] > 0.5) | ~skin
    filled_in = seen.copy()
    for name, filled in (("eyes", pockets & (masks["eyes"] > 0.5)), ("lips", pockets & (masks["eyes"] <= 0.5))):
        rim = (masks[name] > 0.5) & ~pockets
        for half in (side, ~side):
            filled_in[filled & half] = min(seen[rim & half].mean() / POCKET_SHARE, 1.0)
    return filled_in
