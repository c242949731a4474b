"""Motion of control points."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from tress.base.errors import InputError
from tress.model.group import Group
from tress.model.record import Record, array
from tress.model.strip import Strip
from tress.model.tracks import INTERPOLATIONS, Track, blended, flat_tracks

if TYPE_CHECKING:
    from tress.model.document import Document

Array = np.ndarray[Any, Any]

KINDS = ("displacement", "position")
FRAMES = ("root", "head")
MIN_STEP_SECS, MAX_TIME_SECS = 1e-6, 1e9


@dataclass(frozen=True, eq=False)
class Keyframes(Record):
    """K moments in the motion of a strip, or of every strip of a group; between them it is interpolated.

    `values` are displacements of control points, added to where they rest, or, for a strip alone, their positions.
    `frame` says along which axes: those in which the control points are kept (`root`: the root's, where the strip is
    attached), or those of the head. A net of another size than a strip's is stretched over it, so (K, 1, 1, 3) moves
    all points alike. `linear`, `step` and `cubic` stand between the moments; cubic goes by `tangents` (values per
    second) or, without them, by the slopes of the parabolas through each three moments (Catmull-Rom where times are
    even). Before the first moment and after the last one the motion stands still, or repeats with `loop`, the last
    moment being the first again. Where several records move one strip, positions come first, and displacements add up.
    Raises `InputError` for times that do not rise, and for tangents of another interpolation.
    """

    target: str
    times: Array = array("f8", "K", doc="Seconds, rising.")
    values: Array = array("f8", "K", "U", "V", 3, doc="Displacements or positions of control points, metres.")
    tangents: Array | None = array("f8", "K", "U", "V", 3, optional=True, doc="Metres per second, for cubic.")
    interpolation: str = "cubic"
    kind: str = "displacement"
    frame: str = "root"
    loop: bool = False

    def check(self) -> None:
        """Times rise, names are known, and nothing contradicts."""
        for name, options in (("interpolation", INTERPOLATIONS), ("kind", KINDS), ("frame", FRAMES)):
            if getattr(self, name) not in options:
                raise InputError(
                    f"Keyframes.{name} is {getattr(self, name)!r}; one of {', '.join(options)} was expected."
                )
        if not len(self.times) or not self.values.size:
            raise InputError("Keyframes hold no moment or no control point; at least one of each was expected.")
        if (np.diff(self.times) < MIN_STEP_SECS).any() or np.abs(self.times).max() > MAX_TIME_SECS:
            raise InputError(f"Keyframes.times is {self.times}; rising seconds were expected.")
        if self.tangents is not None and self.interpolation != "cubic":
            raise InputError(f"Keyframes.tangents are given for {self.interpolation!r}; they belong to 'cubic'.")
        if self.kind == "position" and self.frame != "root":
            raise InputError("Keyframes of positions are in the frame 'root', that of the strip's control points.")
        if self.loop and len(self.times) < 2:
            raise InputError("Keyframes.loop needs two moments or more.")

    def check_in(self, document: "Document", *, name: str) -> None:
        """The target is there; positions are those of its control points."""
        target = document.records.get(self.target)
        if not isinstance(target, Strip | Group):
            raise InputError(f"Keyframes {name!r} move {self.target!r}, which is no strip or group of the document.")
        if self.kind == "position" and not (isinstance(target, Strip) and target.points.shape == self.values.shape[1:]):
            raise InputError(f"Keyframes {name!r} hold positions, but not for the control points of {self.target!r}.")

    def at(self, time: float) -> Array:
        """(U, V, 3) float64 values at `time` (seconds).

        >>> shift = np.arange(6.0).reshape(2, 1, 1, 3)
        >>> Keyframes(target="a", times=[0, 2], values=shift, interpolation="linear").at(1.0).tolist()
        [[[1.5, 2.5, 3.5]]]
        """
        shape = self.values.shape[1:3]
        tracks = flat_tracks([Track(self, shape)])
        return blended(tracks, np.arange(shape[0] * shape[1]), np.zeros(shape[0] * shape[1], int), time).reshape(
            *shape, 3
        )
