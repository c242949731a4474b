"""How copies of strips differ: ranges, one number drawn from each for every copy."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tress.base.errors import ParameterError
from tress.base.params import Params, param
from tress.model.knots import domain_of
from tress.model.strip import Strip
from tress.model.strip_axes import strip_axes

Array = np.ndarray[Any, Any]

HALF_TURN = 3.141592653589793
PAIRS = ("turn", "tilt", "curl", "length", "width", "weight", "knot")


@dataclass(frozen=True)
class Variation(Params):
    """Ranges from which every copy draws; by default copies are like their originals.

    Angles are about the strip's own axes at its root: the normal (turn), across (tilt, curl). Raises `ParameterError`
    where a low end lies above the high one.
    """

    location_m: float = param(0.0, low=0, high=1, unit="m", doc="Shift of the root in any direction, up to this far.")
    turn_low: float = param(0.0, low=-HALF_TURN, high=HALF_TURN, unit="rad", doc="Least turn about the normal.")
    turn_high: float = param(0.0, low=-HALF_TURN, high=HALF_TURN, unit="rad", doc="Greatest turn about the normal.")
    tilt_low: float = param(0.0, low=-HALF_TURN, high=HALF_TURN, unit="rad", doc="Least lift off the surface.")
    tilt_high: float = param(0.0, low=-HALF_TURN, high=HALF_TURN, unit="rad", doc="Greatest lift off the surface.")
    curl_low: float = param(0.0, low=-20, high=20, unit="rad", doc="Least bend from root to tip, outwards.")
    curl_high: float = param(0.0, low=-20, high=20, unit="rad", doc="Greatest bend from root to tip, outwards.")
    length_low: float = param(1.0, low=0.01, high=100, doc="Least factor of the length.")
    length_high: float = param(1.0, low=0.01, high=100, doc="Greatest factor of the length.")
    width_low: float = param(1.0, low=0.01, high=100, doc="Least factor of the width.")
    width_high: float = param(1.0, low=0.01, high=100, doc="Greatest factor of the width.")
    weight_low: float = param(1.0, low=0.01, high=100, doc="Least factor of each weight.")
    weight_high: float = param(1.0, low=0.01, high=100, doc="Greatest factor of each weight.")
    knot_low: float = param(1.0, low=0.1, high=10, doc="Least power of the inner knots' place along the strip.")
    knot_high: float = param(1.0, low=0.1, high=10, doc="Greatest power of the inner knots' place along the strip.")

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in PAIRS:
            low, high = getattr(self, f"{name}_low"), getattr(self, f"{name}_high")
            if low > high:
                raise ParameterError(f"{name}_low is {low} and {name}_high {high}; low <= high was expected.")


@dataclass(frozen=True)
class Drawn:
    """What one copy drew: `location_m` (2,) along two tangents of the surface, `weight` (U, V), else single numbers."""

    location_m: Array
    turn: float
    tilt: float
    curl: float
    length: float
    width: float
    weight: Array
    knot: float


def drawn(variation: Variation, rng: np.random.Generator, *, shape: tuple[int, ...]) -> Drawn:
    """The numbers of one copy of a strip with a net of `shape`. Always the same count of draws."""
    radius, angle = variation.location_m * np.sqrt(rng.random()), rng.uniform(0, 2 * np.pi)
    turn, tilt, curl, length, width = (
        float(rng.uniform(getattr(variation, f"{name}_low"), getattr(variation, f"{name}_high")))
        for name in ("turn", "tilt", "curl", "length", "width")
    )
    weight = np.exp(rng.uniform(np.log(variation.weight_low), np.log(variation.weight_high), shape))
    knot = float(np.exp(rng.uniform(np.log(variation.knot_low), np.log(variation.knot_high))))
    return Drawn(radius * np.array([np.cos(angle), np.sin(angle)]), turn, tilt, curl, length, width, weight, knot)


def varied(strip: Strip, change: Drawn) -> Strip:
    """The strip with another shape at the same root; its place is left to the caller.

    Length, width and curl keep the spacing of rows, so a strip of length 1 has length `length`, however it curls.
    Raises `InputError` where the strip has no length or width.
    """
    return replace(
        strip,
        points=_varied_net(strip.points, change),
        weights=strip.weights * change.weight,
        knots_u=_warped(strip.knots_u, strip.weights.shape[0], change.knot),
    )


def _varied_net(net: Array, change: Drawn) -> Array:
    if (change.turn, change.tilt, change.curl, change.length, change.width) == (0, 0, 0, 1, 1):
        return net
    axes, root = strip_axes(net), net[0].mean(axis=0)
    own = (net - root) @ axes
    centres = own.mean(axis=1)
    steps = change.length * np.diff(centres, axis=0)
    across = own - centres[:, None]
    across[..., 1] *= change.width

    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(steps, axis=1))])
    bend = about_across(change.curl * along / max(along[-1], 1e-30))
    step_bend = about_across(change.curl * (along[1:] + along[:-1]) / 2 / max(along[-1], 1e-30))
    places = np.concatenate([np.zeros((1, 3)), np.cumsum(np.einsum("uij,uj->ui", step_bend, steps), axis=0)])
    own = places[:, None] + np.einsum("uij,uvj->uvi", bend, across)

    turned = own @ about_across(np.array([change.tilt]))[0].T @ about_normal(change.turn).T
    return turned @ axes.T + root


def about_across(angle: Array) -> Array:
    """(N, 3, 3) rotations by `angle` (N,) that lift the direction along (x) towards the normal (z)."""
    result = np.zeros((len(angle), 3, 3))
    result[:, 0, 0] = result[:, 2, 2] = np.cos(angle)
    result[:, 0, 2], result[:, 2, 0] = -np.sin(angle), np.sin(angle)
    result[:, 1, 1] = 1
    return result


def about_normal(angle: float) -> Array:
    """(3, 3) rotation by `angle` about z, counter-clockwise seen from outside."""
    return np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])


def _warped(knots: Array, count: int, power: float) -> Array:
    """Inner knots moved along the strip: their share of the domain to a power, which keeps order and ends."""
    if power == 1:
        return knots
    low, high = domain_of(knots, count=count)
    inside = (knots > low) & (knots < high)
    result = np.array(knots)
    result[inside] = low + (high - low) * ((knots[inside] - low) / (high - low)) ** power
    return result
