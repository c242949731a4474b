"""Wind on a surface, as keyframes: waves that run down it and along it."""

from dataclasses import dataclass

import numpy as np

from tress.base.params import Params, param
from tress.model.keyframes import Keyframes

ROWS, COLUMNS, MOMENTS = 10, 8, 8


@dataclass(frozen=True)
class FlutterParams(Params):
    """How a surface flutters."""

    amplitude_m: float = param(0.035, low=0.0, high=1.0, unit="m", doc="How far tips go to each side.")
    period_secs: float = param(1.6, low=0.1, high=60.0, unit="s", doc="Time of a gust; the motion repeats after it.")
    direction: float = param(0.0, low=-360, high=360, unit="degrees", doc="0 blows to the head's left, 90 forwards.")
    stiffness: float = param(1.8, low=0.5, high=6.0, doc="How much roots hold: the power of the growth to the tip.")
    waves_down: float = param(0.7, low=0.0, high=10.0, doc="Waves between root and tip.")
    waves_along: float = param(0.6, low=0.0, high=10.0, doc="Waves from one side of the surface to the other.")


def flutter(surface: str, *, params: FlutterParams = FlutterParams()) -> dict[str, Keyframes]:
    """A looping motion of the strip `surface`, for a document: displacements over its rows and columns.

    Every place swings along the wind, with half the height up and down at a quarter's delay.
    """
    u, v = np.linspace(0, 1, ROWS)[:, None], np.linspace(0, 1, COLUMNS)
    time = np.linspace(0, 1, MOMENTS + 1)[:, None, None]
    phase = 2 * np.pi * (time - params.waves_down * u - params.waves_along * v)
    angle = np.radians(params.direction)
    along, up = np.array([np.cos(angle), 0.0, np.sin(angle)]), np.array([0.0, 1.0, 0.0])
    swing = np.sin(phase)[..., None] * along + 0.5 * np.cos(phase)[..., None] * up
    swing = swing + 0.25 * np.sin(2 * phase + 1)[..., None] * along
    values = params.amplitude_m * u[..., None] ** params.stiffness * swing
    values[-1] = values[0]
    times = time.ravel() * params.period_secs
    return {f"{surface}_flutter": Keyframes(target=surface, times=times, values=values, frame="head", loop=True)}
