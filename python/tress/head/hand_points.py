"""Landmarks given by hand: all 468, or a few named points that say where the face is.

A file is JSON: either `[[x, y], ...]` or `{"points": [[x, y], ...]}` with 468 points (a third number is the depth
towards the camera, px), or an object of named points such as `{"right_eye": [412, 388], "left_eye": [540, 380],
"chin": [470, 640]}`. Left and right are the person's own. Both eyes are needed; every further name helps.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError
from tress.head.landmarks import COUNT, FaceLandmarks, landmarks_of
from tress.head.pose import Pose, refined_pose
from tress.head.statistical import StatisticalHead, load_statistical_head

NAMED: Mapping[str, tuple[int, ...]] = {
    "right_eye": (33, 133),
    "left_eye": (263, 362),
    "right_eye_outer": (33,),
    "right_eye_inner": (133,),
    "left_eye_inner": (362,),
    "left_eye_outer": (263,),
    "nose": (1,),
    "mouth": (13, 14),
    "mouth_right": (61,),
    "mouth_left": (291,),
    "chin": (152,),
    "forehead": (10,),
}
"""Names that a file may hold, and the landmarks whose middle each means."""
ENOUGH_FOR_TURNING = 4
"""With fewer points the head is taken to face the camera."""

HandPoints = FaceLandmarks | dict[str, tuple[float, float]]


def read_hand_points(path: Path) -> HandPoints:
    """The landmarks of a JSON file: `FaceLandmarks` where all 468 are given, else the named points, px.

    Raises `InputError` where the file does not hold one or the other.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise InputError(f"The landmarks {path} cannot be read as JSON: {error}.") from error
    points = content.get("points") if isinstance(content, dict) else content
    if points is not None:
        return _all_points(points, path)
    return {name: _named_point(name, value, path) for name, value in content.items()}


def landmarks_from_named(
    points: Mapping[str, tuple[float, float]], *, head: StatisticalHead | None = None
) -> FaceLandmarks:
    """All 468 landmarks of an average face that is laid on the named points, px.

    Raises `InputError` where an eye is missing or both are in one place.
    """
    head = head or load_statistical_head()
    rest = head.at_landmarks(head.mean)
    names = sorted(points)
    anchors = np.stack([rest[list(NAMED[name])].mean(axis=0) for name in names])
    target = np.array([[*points[name], 0.0] for name in names])
    pose = _facing(anchors, target, names)
    if len(names) >= ENOUGH_FOR_TURNING:
        weight = np.ones(len(names))
        pose = refined_pose(pose, anchors, target, weight=weight, depth_weight=0.0, rounds=20)
    return landmarks_of(pose.seen(rest))


def _facing(anchors: NDArray[np.float64], target: NDArray[np.float64], names: list[str]) -> Pose:
    """The pose of a head that faces the camera with its eyes in their places."""
    if not {"left_eye", "right_eye"} <= set(names):
        raise InputError(f"The landmarks name {', '.join(names) or 'nothing'}; left_eye and right_eye are needed.")
    right, left = names.index("right_eye"), names.index("left_eye")
    across, seen = anchors[left] - anchors[right], (target[left] - target[right])[:2]
    scale = float(np.linalg.norm(seen) / np.linalg.norm(across))
    if scale <= 0:
        raise InputError("Both eyes are given in the same place; two different points are needed.")
    cos, sin = seen[0] / np.linalg.norm(seen), -seen[1] / np.linalg.norm(seen)
    rotation = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    middle = (target[left] + target[right]) / 2
    flipped = scale * rotation @ ((anchors[left] + anchors[right]) / 2) * [1.0, -1.0, 1.0]
    return Pose(rotation, scale, middle - flipped)


def _all_points(points: Any, path: Path) -> FaceLandmarks:
    try:
        array = np.asarray(points, np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"The landmarks {path} are not a list of points.") from error
    if array.ndim != 2 or array.shape[0] != COUNT or array.shape[1] not in (2, 3):
        raise InputError(f"The landmarks {path} hold an array of {array.shape}; {COUNT} points x, y were expected.")
    return landmarks_of(array)


def _named_point(name: str, value: Any, path: Path) -> tuple[float, float]:
    if name not in NAMED:
        raise InputError(f"The landmarks {path} name {name!r}; one of {', '.join(NAMED)} was expected.")
    try:
        x, y = (float(number) for number in value)
    except (TypeError, ValueError) as error:
        raise InputError(f"The point {name} of {path} is {value!r}; two numbers x, y in px were expected.") from error
    return x, y
