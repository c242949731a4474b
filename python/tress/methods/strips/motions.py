"""Motions for strips as keyframes: a sway of whole groups, and wind that travels through the hair.

Roots stay, tips move the most: displacements grow with the length from the root to the power `stiffness`. Of strips on
a scalp only the length counts that lies off it, so that what lies on the head, up to a tie behind it, keeps still and
what hangs swings. Every motion is a loop, and the keyframes are as few as cubic interpolation needs.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.base.params import Params, choice, param
from tress.edit.selection import editable_strips
from tress.methods.strips.hanging_growth import ROWS, hanging_growth
from tress.model.document import Document
from tress.model.keyframes import Keyframes
from tress.model.strip_set import posed_points, strip_set
from tress.model.tracks import INTERPOLATIONS

Array = np.ndarray[Any, Any]

MOMENTS = 8
"""Keyframes of a period: cubic pieces between them follow a sine within 0.2 per cent."""
WAVES, GUST_M, LOOSE = 4, 0.25, 0.15
"""Of the chance in a wind: how many waves, how long each, and the part in which every strip is on its own."""
GUST = 0.35
"""How much of the wind is a second, quicker wave."""


@dataclass(frozen=True)
class MotionParams(Params):
    """How hair moves."""

    amplitude_m: float = param(0.02, low=0.0, high=1.0, unit="m", doc="How far tips move.")
    period_secs: float = param(2.0, low=0.1, high=60.0, unit="s", doc="Time of one swing; the clip repeats after it.")
    direction: float = param(
        0.0, low=-360.0, high=360.0, unit="degrees", doc="0 moves to the head's left, 90 forwards."
    )
    stiffness: float = param(1.6, low=0.5, high=6.0, doc="How much the roots hold: the power of the growth to the tip.")
    variety: float = param(0.25, low=0.0, high=1.0, doc="How much strips of a wind differ in time, by chance.")
    wavelength_m: float = param(0.35, low=0.02, high=10.0, unit="m", doc="From one gust in the hair to the next.")
    interpolation: str = choice("cubic", options=INTERPOLATIONS, doc="Between keyframes.")
    seed: int = param(0, low=0, high=2**32 - 1, doc="Draws the differences of a wind.")


def sway(document: Document, *, targets: Iterable[str], params: MotionParams) -> dict[str, Keyframes]:
    """A motion from side to side together, as in a step of the head: one for each of `targets` (strips or groups), or
    for each strip in them where strips grow on a scalp."""
    phase = _phases()
    swing = params.amplitude_m * np.sin(phase)[:, None] * _direction(params)
    swing = swing + 0.1 * params.amplitude_m * (1 - np.cos(2 * phase))[:, None] * np.array([0.0, 1.0, 0.0])
    targets = tuple(targets)
    growth = hanging_growth(document, editable_strips(document, targets), stiffness=params.stiffness)
    if growth:
        return {f"{name}_sway": _keyframes(name, swing, params, grown) for name, grown in growth.items()}
    return {f"{name}_sway": _keyframes(name, swing, params, _even_growth(params.stiffness)) for name in targets}


def wind(document: Document, *, targets: Iterable[str], params: MotionParams) -> dict[str, Keyframes]:
    """A motion for every strip within `targets`: gusts reach strips one after the other, as they lie along the wind.

    The hair leans with the wind by half the amplitude and flutters about that.
    """
    names = list(editable_strips(document, targets))
    strips = strip_set(document, names)
    tips = np.array([net[-1].mean(axis=0) for net in strips.nets(posed_points(strips))]).reshape(-1, 3)
    delay = 2 * np.pi * (tips @ _direction(params)) / params.wavelength_m
    delay += np.pi * params.variety * _gusts(tips, seed=params.seed)
    growth = hanging_growth(document, names, stiffness=params.stiffness)
    lift = np.array([0.0, 1.0, 0.0])
    moved = {}
    for name, late in zip(names, delay, strict=True):
        phase = _phases() - late
        along = 0.5 + 0.5 * np.sin(phase) + 0.5 * GUST * np.sin(2 * phase + late)
        up = 0.15 * (1 + np.sin(phase + 1))
        swing = params.amplitude_m * (along[:, None] * _direction(params) + up[:, None] * lift)
        moved[f"{name}_wind"] = _keyframes(name, swing, params, growth.get(name, _even_growth(params.stiffness)))
    return moved


MOTIONS: Mapping[str, Callable[..., dict[str, Keyframes]]] = {"sway": sway, "wind": wind}


def motion_of(name: str) -> Callable[..., dict[str, Keyframes]]:
    """The motion of that name. Raises `InputError` for an unknown one."""
    if name not in MOTIONS:
        raise InputError(f"Motion {name!r} is unknown; one of {', '.join(MOTIONS)} was expected.")
    return MOTIONS[name]


def _phases() -> Array:
    return np.linspace(0, 2 * np.pi, MOMENTS + 1)


def _direction(params: MotionParams) -> Array:
    angle = np.radians(params.direction)
    return np.array([np.cos(angle), 0.0, np.sin(angle)])


def _even_growth(stiffness: float) -> Array:
    return np.linspace(0, 1, ROWS) ** stiffness


def _gusts(places: Array, *, seed: int) -> Array:
    """(S,) in about [-1, 1]: differences by chance between strips with tips at `places` (S, 3), metres; strips side by
    side differ little, or a tail would fray."""
    random = np.random.default_rng(seed)
    ways = random.normal(size=(WAVES, 3))
    ways *= (2 * np.pi / GUST_M / np.linalg.norm(ways, axis=1))[:, None]
    smooth = np.sin(places @ ways.T + random.uniform(-np.pi, np.pi, WAVES)).sum(axis=1) / np.sqrt(WAVES)
    return (1 - LOOSE) * smooth + LOOSE * random.uniform(-1, 1, len(places))


def _keyframes(target: str, swing: Array, params: MotionParams, growth: Array) -> Keyframes:
    """The displacement `swing` (K, 3) of tips, grown from root to tip by `growth` (ROWS,)."""
    values = swing[:, None, None, :] * growth[:, None, None]
    values[-1] = values[0]
    times = _phases() / (2 * np.pi) * params.period_secs
    return Keyframes(
        target=target, times=times, values=values, interpolation=params.interpolation, frame="head", loop=True
    )
