"""What differs from clump to clump by chance."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.base.params import Params, param

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class ClumpVariation(Params):
    """Ranges from which every clump draws evenly. Raises `InputError` where a range is upside down."""

    radius_low: float = param(1.0, low=0.01, high=100.0, doc="Least factor of both radii.")
    radius_high: float = param(1.0, low=0.01, high=100.0, doc="Greatest factor of both radii.")
    length_low: float = param(1.0, low=0.0, high=1.0, doc="Least part of the length.")
    length_high: float = param(1.0, low=0.0, high=1.0, doc="Greatest part of the length.")
    twist_low: float = param(0.0, low=-100.0, high=100.0, unit="rad", doc="Least turn of the tip about the hair.")
    twist_high: float = param(0.0, low=-100.0, high=100.0, unit="rad", doc="Greatest turn of the tip about the hair.")
    lift_low: float = param(0.0, low=-10.0, high=10.0, unit="m", doc="Least way along the normal.")
    lift_high: float = param(0.0, low=-10.0, high=10.0, unit="m", doc="Greatest way along the normal.")
    seed: int = param(0, low=0, high=2**32 - 1, doc="Same ranges, number of hairs and seed: the same bits.")

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("radius", "length", "twist", "lift"):
            low, high = getattr(self, f"{name}_low"), getattr(self, f"{name}_high")
            if low > high:
                raise InputError(f"{name}_low is {low}, above {name}_high {high}; a range was expected.")


@dataclass(frozen=True, eq=False)
class Varied:
    """What n clumps drew, each (n,) float64: factors of `radius` and `length`, `twist` in radians, `lift` in metres."""

    radius: Array
    length: Array
    twist: Array
    lift: Array


def varied(variation: ClumpVariation, *, count: int) -> Varied:
    """Draws for `count` clumps; whoever asks for one thing more draws the rest as before.

    >>> varied(ClumpVariation(length_low=0.5), count=2).twist.tolist()
    [0.0, 0.0]
    """
    share = np.random.default_rng(variation.seed).uniform(size=(count, 4)).T

    def within(name: str, part: Array) -> Array:
        low, high = getattr(variation, f"{name}_low"), getattr(variation, f"{name}_high")
        return low + (high - low) * part

    return Varied(
        *(within(name, part) for name, part in zip(("radius", "length", "twist", "lift"), share, strict=True))
    )
