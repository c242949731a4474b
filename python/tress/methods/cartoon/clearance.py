"""Key hairs kept off a head."""

from typing import Any

import numpy as np

from tress.edit.surface_distance import distances
from tress.methods.cartoon.key_hairs import KeyHairs
from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]

ROUNDS = 6
LONGEST_STEP_M = 0.02


def kept_off(hairs: KeyHairs, *, mesh: Mesh, room: Array) -> KeyHairs:
    """The hairs with every control point at least `room` (n, p) metres outside a closed mesh: where it is nearer, it
    goes straight away from the surface, and its neighbours along the hair part of the way, so that hairs stay smooth.

    `mesh` is the outer `skin` of a head; normals stay. Where the way out changes within a few points, deep inside,
    hairs come out crumpled.
    """
    points = hairs.points.copy()
    wanted = np.broadcast_to(room, points.shape[:2])
    for round_ in range(ROUNDS):
        distance, outwards = distances(mesh, points.reshape(-1, 3))
        missing = np.clip(wanted - distance.reshape(wanted.shape), 0, LONGEST_STEP_M)
        if missing.max() < 1e-6:
            break
        move = missing[..., None] * outwards.reshape(points.shape)
        points += move if round_ >= ROUNDS - 2 else _spread(move)
    return KeyHairs(points, hairs.normals)


def _spread(move: Array) -> Array:
    """Ways (n, p, 3), each with half of its neighbours' where these go farther."""
    padded = np.pad(move, ((0, 0), (1, 1), (0, 0)), mode="edge")
    between = 0.25 * padded[:, :-2] + 0.5 * move + 0.25 * padded[:, 2:]
    farther = np.linalg.norm(between, axis=-1) > np.linalg.norm(move, axis=-1)
    return np.where(farther[..., None], between, move)
