"""The perspective of a portrait, taken off what is seen and put back on what was fitted.

The camera stands some two metres away, so what lies 10 cm nearer looks 5 % larger: the face against the ears, the ears
against the back of the skull. The fit works in scaled orthography, with the scale at the head's origin. Landmarks are
first brought to where orthography would show them, and the fitted head is last enlarged towards the camera, so that it
lies on the photograph again. Without this the face sets the scale of the whole head, and the cranium, which stands
farther off, comes out some 3 mm too large all around.

Limits: the camera's distance is a guess where the user does not give it, and its axis is taken to meet the head.
"""

import numpy as np
from numpy.typing import NDArray

from tress.head.pose import Pose


def enlargement(points_in_head: NDArray[np.float64], pose: Pose, *, distance: float) -> NDArray[np.float64]:
    """How much larger things look at `points_in_head` (N, 3) than at the origin, from `distance` metres: (N,)."""
    toward = (points_in_head * pose.rotation[2]).sum(axis=1)
    return distance / np.maximum(distance - toward, 0.1 * distance)


def seen_in_perspective(points_in_head: NDArray[np.float64], pose: Pose, *, distance: float) -> NDArray[np.float64]:
    """Where the camera sees `points_in_head` (N, 3): (N, 2) px."""
    middle = pose.offset[:2]
    factor = enlargement(points_in_head, pose, distance=distance)[:, None]
    return middle + (pose.seen(points_in_head)[:, :2] - middle) * factor


def without_perspective(
    target: NDArray[np.float64], points_in_head: NDArray[np.float64], pose: Pose, *, distance: float
) -> NDArray[np.float64]:
    """`target` (N, 3), u, v and depth px, with u and v where orthography would show the `points_in_head` (N, 3)."""
    middle = pose.offset[:2]
    factor = enlargement(points_in_head, pose, distance=distance)[:, None]
    return np.column_stack([middle + (target[:, :2] - middle) / factor, target[:, 2]])
