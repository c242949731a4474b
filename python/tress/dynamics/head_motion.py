"""How a head moves under hair."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from tress.base.errors import InputError
from tress.kernel.arrays import checked
from tress.kernel.dynamics import STILL

Array = np.ndarray[Any, Any]
HeadMotion = Callable[[float], Array]
"""A pose at any time in seconds: (7,) quaternion x y z w and translation in metres, from the head's own place."""

_NECK = np.array([0.0, -0.11, -0.02])
"""About which a head turns, metres from its centre."""


def still(_secs: float) -> Array:
    """A head at rest."""
    return STILL


def turn(secs: float) -> Array:
    """A look to the left and back, with a rest after it: 45 degrees within a third of a second."""
    return _about_neck([0, np.radians(45) * (_eased(secs, 0.2, 0.55) - _eased(secs, 1.3, 1.65)), 0])


def shake(secs: float) -> Array:
    """Two shakes of the head, then rest."""
    fading = _eased(secs, 0.1, 0.3) - _eased(secs, 1.3, 1.5)
    return _about_neck([0, np.radians(28) * fading * np.sin(2 * np.pi * 1.7 * (secs - 0.1)), 0])


def nod(secs: float) -> Array:
    """A nod, then rest."""
    return _about_neck([np.radians(30) * (_eased(secs, 0.2, 0.5) - _eased(secs, 0.8, 1.1)), 0, 0])


def walk(secs: float) -> Array:
    """Steps, two a second, without end: up and down, and from side to side."""
    phase = 2 * np.pi * secs
    sway, rise = 0.012 * np.sin(phase), 0.015 * np.cos(2 * phase)
    return np.concatenate([Rotation.from_euler("z", 0.03 * np.sin(phase)).as_quat(), [sway, rise, 0.0]])


HEAD_MOTIONS: Mapping[str, HeadMotion] = {"still": still, "turn": turn, "shake": shake, "nod": nod, "walk": walk}


def head_motion_of(name: str) -> HeadMotion:
    """The motion of that name. Raises `InputError` for an unknown one."""
    if name not in HEAD_MOTIONS:
        raise InputError(f"Head motion {name!r} is unknown; one of {', '.join(HEAD_MOTIONS)} was expected.")
    return HEAD_MOTIONS[name]


def keyed(times: Any, poses: Any) -> HeadMotion:
    """A motion through `poses` (K, 7) at `times` (K,) seconds, rising: turned the short way, moved straight; still
    before and after. Raises `InputError` for times that do not rise and poses without a rotation.

    >>> keyed([0, 1], [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 2, 0, 0]])(0.5)[4:].tolist()
    [1.0, 0.0, 0.0]
    """
    moments = checked(times, name="times", dtype=np.float64, shape=(None,))
    given = checked(poses, name="poses", dtype=np.float64, shape=(len(moments), 7))
    if not len(moments) or (np.diff(moments) <= 0).any():
        raise InputError(
            "The times of the head's motion do not rise; at least one, each later than the last, was expected."
        )
    if (np.linalg.norm(given[:, :4], axis=1) < 1e-9).any():
        raise InputError("A pose of the head has no rotation; a quaternion x y z w was expected.")
    turns = Rotation.from_quat(given[:, :4])
    between = Slerp(moments, turns) if len(moments) > 1 else None

    def at(secs: float) -> Array:
        clamped = float(np.clip(secs, moments[0], moments[-1]))
        rotation = turns[0] if between is None else between(clamped)
        moved = [np.interp(clamped, moments, given[:, 4 + axis]) for axis in range(3)]
        return np.concatenate([rotation.as_quat(), moved])

    return at


def moved(points: Array, *, pose: Array) -> Array:
    """Points (N, 3) of the head frame where the head is."""
    return Rotation.from_quat(pose[:4]).apply(points) + pose[4:]


def moved_back(points: Array, *, pose: Array) -> Array:
    """Points (N, 3) in the head frame again."""
    return Rotation.from_quat(pose[:4]).inv().apply(points - pose[4:])


def _about_neck(angles: Any) -> Array:
    rotation = Rotation.from_rotvec(angles)
    return np.concatenate([rotation.as_quat(), _NECK - rotation.apply(_NECK)])


def _eased(secs: float, start: float, end: float) -> float:
    """From 0 to 1 with neither speed nor acceleration at the ends."""
    t = float(np.clip((secs - start) / (end - start), 0, 1))
    return t**3 * (10 - 15 * t + 6 * t * t)
