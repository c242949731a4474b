"""Motion of chains of particles: springs to lengths, bends and goals, wind, drag, collisions; compliant constraints in
small steps (Macklin et al. 2019), those along a chain solved all at once.

Raises `InputError` for shapes that do not fit, and numbers that are not finite or outside their ranges.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.base.params import Params, choice, param
from tress.kernel.arrays import checked

Array = np.ndarray[Any, Any]

STILL = np.array([0.0, 0, 0, 1, 0, 0, 0])
"""The pose of what stays where it is: a quaternion x y z w, then a translation in metres."""


@dataclass(frozen=True)
class DynamicsParams(Params):
    """What hair is made of and what acts on it. A stiffness may be infinite in all but name: 1e9 is solved as 1 is."""

    gravity: float = param(9.81, low=-100.0, high=100.0, unit="m/s²", doc="Acceleration downwards.")
    stretch: float = param(100.0, low=0.0, high=1e9, unit="N", doc="Pull that would double the length.")
    bend: float = param(2e-6, low=0.0, high=1e9, unit="N m²", doc="Stiffness against bending out of the goal's shape.")
    goal: float = param(0.5, low=0.0, high=1e9, unit="N/m", doc="Stiffness of the spring to a goal of weight 1/2.")
    across: float = param(20.0, low=0.0, high=1e9, unit="N/m", doc="Stiffness of springs between chains.")
    drag: float = param(2.0, low=0.0, high=1e3, unit="1/s", doc="Rate at which hair takes on the air's velocity.")
    damping: float = param(4.0, low=0.0, high=1e3, unit="1/s", doc="Rate at which motion within a chain dies down.")
    wind_speed: float = param(0.0, low=0.0, high=100.0, unit="m/s", doc="Mean speed of the wind.")
    wind_yaw: float = param(0.0, low=-7.0, high=7.0, unit="rad", doc="Where it comes from: 0 the front, π/2 the left.")
    wind_pitch: float = param(0.0, low=-1.6, high=1.6, unit="rad", doc="How far from below it comes.")
    gusts: float = param(0.6, low=0.0, high=5.0, doc="Strength of gusts as part of the wind's speed.")
    gust_secs: float = param(1.5, low=0.01, high=1e3, unit="s", doc="Time from gust to gust.")
    seed: int = param(0, low=0, high=2**63 - 1, doc="Gusts of another seed come at other times.")
    friction: float = param(0.3, low=0.0, high=10.0, doc="Coulomb's coefficient on what hair lies on.")
    clearance: float = param(0.01, low=0.0, high=1.0, unit="m", doc="Distance from things, unless its goal is nearer.")
    chain_distance: float = param(0.0, low=0.0, high=1.0, unit="m", doc="Distance between chains; 0: they may pass.")
    roots: str = choice("clamped", options=("clamped", "hinged"), doc="Whether roots keep the goal's direction.")
    substeps: int = param(6, low=1, high=1000, doc="Steps a frame.")
    iterations: int = param(1, low=1, high=1000, doc="Rounds over the constraints a step.")

    @property
    def wind(self) -> Array:
        """(3,) velocity of the mean wind, metres a second: left is the head's, +X; front is +Z."""
        level = np.cos(self.wind_pitch)
        towards = (-np.sin(self.wind_yaw) * level, np.sin(self.wind_pitch), -np.cos(self.wind_yaw) * level)
        return self.wind_speed * np.array(towards)


@dataclass(frozen=True, eq=False)
class Chains:
    """Chain c is the particles `offsets[c]:offsets[c + 1]`, root first. `mass` (N,) kg > 0; `goal_weight` (N,) in
    [0, 1]: 0 hangs free, 1 follows its goal exactly. `links` (L, 2): particles joined across chains."""

    offsets: Array
    mass: Array
    goal_weight: Array
    links: Array = field(default_factory=lambda: np.zeros((0, 2), np.int64))


@dataclass(frozen=True, eq=False)
class Particles:
    """`position` (N, 3) metres and `velocity` (N, 3) metres a second, float64."""

    position: Array
    velocity: Array


class DistanceField:
    """Signed distances (Z, Y, X) float32, metres, negative inside, to a mesh; `origin` (3,) is the first point."""

    def __init__(self, values: Array, *, origin: Array, spacing: float) -> None:
        lattice = np.ascontiguousarray(values, np.float32)
        if lattice.ndim != 3 or min(lattice.shape) < 2 or not np.isfinite(lattice).all():
            raise InputError(f"the distances are {lattice.shape}; finite ones on (2+, 2+, 2+) points were expected.")
        if not spacing > 0:
            raise InputError(f"the spacing is {spacing}; a number > 0 was expected.")
        self._field = _core.DynamicsField(list(map(float, origin)), float(spacing), lattice)


@dataclass(frozen=True, eq=False)
class Colliders:
    """What hair stays out of: `capsules` (K, 7): two ends and a radius, metres, and distance `fields` (F), each in a
    frame of its own. `before` and `after` (K + F, 7): their poses when a frame begins and ends, as `STILL`."""

    capsules: Array = field(default_factory=lambda: np.zeros((0, 7)))
    fields: tuple[DistanceField, ...] = ()
    before: Array | None = None
    after: Array | None = None


def advanced(
    particles: Particles,
    *,
    chains: Chains,
    goals: tuple[Array, Array],
    start_secs: float,
    duration_secs: float,
    params: DynamicsParams = DynamicsParams(),
    colliders: Colliders = Colliders(),
) -> Particles:
    """The particles after a frame in which their `goals` (N, 3) go from the first to the second.

    Segments and corners keep the lengths and bends of the goals. The same bits on any number of threads. Cost: some
    0.4 µs a particle and substep on one core. Limits: hair is tested at particles and the middles of segments only, and
    moves through what is thinner than a step of it.

    >>> straight = np.array([[0.0, 0, 0], [0.1, 0, 0]])
    >>> chains = Chains(offsets=[0, 2], mass=[1e-4, 1e-4], goal_weight=[1, 0])
    >>> at = Particles(straight, 0 * straight)
    >>> for frame in range(120):
    ...     at = advanced(at, chains=chains, goals=(straight, straight), start_secs=0, duration_secs=1 / 60,
    ...         params=DynamicsParams(bend=0, goal=0, drag=9))
    >>> bool(np.allclose(at.position[1], [0, -0.1, 0], atol=1e-3))
    True
    """
    position = checked(particles.position, name="position", dtype=np.float64, shape=(None, 3))
    count = len(position)
    arrays = {
        name: checked(values, name=name, dtype=np.float64, shape=(count, 3))
        for name, values in (("velocity", particles.velocity), ("goal before", goals[0]), ("goal after", goals[1]))
    }
    capsules = checked(colliders.capsules, name="capsules", dtype=np.float64, shape=(None, 7))
    poses = [_poses(pose, len(capsules) + len(colliders.fields)) for pose in (colliders.before, colliders.after)]
    try:
        found = _core.dynamics_advance(
            position,
            arrays["velocity"],
            checked(chains.offsets, name="offsets", dtype=np.int64, shape=(None,)),
            checked(chains.mass, name="mass", dtype=np.float64, shape=(count,)),
            checked(chains.goal_weight, name="goal_weight", dtype=np.float64, shape=(count,)),
            (arrays["goal before"], arrays["goal after"]),
            (float(start_secs), float(duration_secs)),
            checked(chains.links, name="links", dtype=np.int64, shape=(None, 2)),
            capsules,
            [item._field for item in colliders.fields],
            tuple(poses),
            _options(params),
        )
    except ValueError as error:
        raise InputError(f"{error}.") from None
    return Particles(*found)


def _options(params: DynamicsParams) -> Any:
    return _core.DynamicsOptions(
        gravity=[0.0, -params.gravity, 0.0],
        stretch_n=params.stretch,
        bend_nm2=params.bend,
        goal_n_per_m=params.goal,
        link_n_per_m=params.across,
        drag_per_sec=params.drag,
        damping_per_sec=params.damping,
        wind=params.wind.tolist(),
        gusts=params.gusts,
        gust_secs=params.gust_secs,
        seed=params.seed,
        friction=params.friction,
        clearance=params.clearance,
        chain_distance=params.chain_distance,
        clamp_roots=params.roots == "clamped",
        substeps=params.substeps,
        iterations=params.iterations,
    )


def _poses(poses: Array | None, count: int) -> Array:
    if poses is None:
        return np.tile(STILL, (count, 1))
    return checked(poses, name="poses", dtype=np.float64, shape=(count, 7))
