"""Motion of many control points as a few fixed displacements with a weight each that changes with time.

Where points are at a time is linear in the values of the keyframes, and a hairdo has few of these: a sway is one or two
displacements, whatever the number of strips. Singular values say how few are enough. This is what morph targets hold.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.model.strip_set import StripSet, posed_points, resting_points

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class PrincipalMotion:
    """M displacements `shapes` (M, N, 3) float64 of control points from rest, metres in the head frame.

    At time `times[k]` (T,) the points are at rest plus the sum of `weights[k]` (T, M) times the shapes, but for at most
    `error_m`. A weight is 1 or -1 where its shape is largest.
    """

    times: Array
    weights: Array
    shapes: Array
    error_m: float


def principal_motion(
    strips: StripSet, *, times: Sequence[float], accuracy: float = 1e-4, most: int = 64
) -> PrincipalMotion:
    """As few displacements as give every control point at every one of `times` within `accuracy` (metres).

    At most `most` are used; `error_m` says what was reached. Points of the surface are means of control points, so the
    error of a strip that is not widened is no larger. Cost: T² N for T times.
    """
    rest = resting_points(strips)
    moved = np.stack([posed_points(strips, time) - rest for time in times]).reshape(len(times), -1)
    values, vectors = np.linalg.eigh(moved @ moved.T)
    order = np.argsort(-values, kind="stable")
    left = moved.copy()
    weights, shapes = [], []
    while (error := _largest(left)) > accuracy and len(shapes) < min(most, len(times)):
        weight = _upright(vectors[:, order[len(shapes)]])
        shape = weight @ moved / (weight @ weight)
        left -= weight[:, None] * shape
        weights.append(weight)
        shapes.append(shape)
    count = len(shapes)
    return PrincipalMotion(
        times=np.asarray(times, np.float64),
        weights=np.array(weights).reshape(count, len(times)).T,
        shapes=np.array(shapes).reshape(count, *rest.shape),
        error_m=error,
    )


def _upright(vector: Array) -> Array:
    """The vector with its largest element made 1."""
    return vector / vector[np.argmax(np.abs(vector))]


def _largest(moved: Array) -> float:
    """The longest displacement of any point at any time, metres."""
    return float(np.sqrt(np.square(moved.reshape(-1, 3)).sum(axis=1).max(initial=0)))
