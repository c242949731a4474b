"""What the simulated hair is and how long it is watched."""

from dataclasses import dataclass

from tress.base.params import Params, param


@dataclass(frozen=True)
class HairParams(Params):
    """Hair of strips, a chain of particles each, besides the forces of `DynamicsParams`."""

    duration_secs: float = param(3.0, low=0.01, high=3600.0, unit="s", doc="Length of the clip.")
    frames_per_sec: float = param(30.0, low=1.0, high=1000.0, unit="1/s", doc="Keyframes a second.")
    settle_secs: float = param(1.0, low=0.0, high=60.0, unit="s", doc="Time to come to rest before the clip begins.")
    density: float = param(0.005, low=1e-9, high=1e3, unit="kg/m", doc="Mass of a metre of a strip.")
    root_goal: float = param(0.4, low=0.0, high=1.0, doc="Goal weight next to the root: 1 follows, 0 hangs free.")
    tip_goal: float = param(0.02, low=0.0, high=1.0, doc="Goal weight at the tip.")
    held: int = param(1, low=1, high=100, doc="Control points from the root on that follow exactly.")
    link_distance: float = param(0.0, low=0.0, high=1.0, unit="m", doc="Strips nearer than this are joined by springs.")
