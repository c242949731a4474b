"""The stage `depth`: how near to the camera every vertex of the strands traced in the photograph is.

The energy of Chai et al. 2012, section 3.3.1, eq. 5. Its depth constraints come from the envelope (`envelope.py`):
strands near the outline, over the head, and along the hairline are held to it with the paper's w_Z; so are the user's
depth strokes. Everywhere else the envelope holds with a weight some hundred times smaller, since strands without any
constraint would leave the system singular. The paper's layering ("observe the local occlusion relationships") is no
term of eq. 5; it is added as an inequality: a vertex flagged occluded lies at least `layer_gap` behind the strand
that crosses over it, which is the nearest one in plain view. Where that is violated a constraint is set and the system
is solved again.
"""

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from scipy.spatial import KDTree

from tress.base.errors import InputError, NoHairError
from tress.base.parallel import together
from tress.base.params import Params, param
from tress.base.report import Report
from tress.kernel import fields
from tress.methods.portrait.envelope import Envelope, Head, hair_envelope
from tress.methods.portrait.resample_picture import pixels_from_columns, spread

Array = np.ndarray[Any, Any]

HAIR_ALPHA = 0.5
"""Pixels with more hair than this belong to the body of hair."""


_CANDIDATES = 12
"""Vertices looked at to find one of another strand: more than one strand has within the radius."""


class Traced(Protocol):
    """What is read of traced strands: `points` (N, 2) px, `offsets` (S + 1,), `occluded` (N,) bool."""

    @property
    def points(self) -> Array: ...
    @property
    def offsets(self) -> Array: ...
    @property
    def occluded(self) -> Array: ...


@dataclass(frozen=True)
class DepthParams(Params):
    """Settings of the strands' depth; w_Z, w_S and w_N are the paper's."""

    depth_weight: float = param(5.0, low=0.0, high=1000.0, doc="w_Z: weight of known depths.")
    strand_weight: float = param(2.0, low=0.0, high=1000.0, doc="w_S: weight of straightness along a strand.")
    neighbour_weight: float = param(1.0, low=0.0, high=1000.0, doc="w_N: weight of likeness to neighbouring strands.")
    envelope_weight: float = param(0.05, low=1e-6, high=1000.0, doc="Weight of the envelope where nothing is known.")
    known_band: float = param(
        0.004, low=0.0, high=0.1, unit="m", doc="Width of the known bands at outline and hairline."
    )
    every: int = param(3, low=1, high=50, doc="Every how many vertices are solved for; the others lie between.")
    unknowns: int = param(30000, low=100, high=10000000, doc="Where there would be more, vertices lie farther apart.")
    neighbour_radius_px: float = param(5.0, low=0.5, high=50.0, unit="px", doc="How far neighbours may be.")
    neighbour_angle: float = param(0.35, low=0.01, high=1.57, unit="rad", doc="How much their directions may differ.")
    neighbour_count: int = param(6, low=1, high=64, doc="Most neighbours of a vertex.")
    layer_gap: float = param(0.001, low=0.0, high=0.02, unit="m", doc="Least depth between crossing strands.")
    layer_rounds: int = param(2, low=0, high=10, doc="Times that violated layers are set right.")
    voxel: float = param(0.003, low=0.0005, high=0.02, unit="m", doc="Size of the voxels around head and hair.")
    accuracy: float = param(1e-5, low=1e-12, high=0.1, doc="Relative residual at which the solver stops.")
    max_iterations: int = param(300, low=1, high=100000, doc="Most steps of the solver.")


@dataclass(frozen=True)
class StrandDepths:
    """`z` (N,) float32 metres towards the camera, one per traced vertex, and the `envelope` that they lie in.

    `iterations` of the last solve, whether it `converged`, and its relative `residual`.
    """

    z: Array
    envelope: Envelope
    iterations: int
    converged: bool
    residual: float


def depth(
    traced: Traced,
    *,
    head: Head,
    alpha: Array,
    solid: Array,
    params: DepthParams = DepthParams(),
    depth_strokes: Array | None = None,
    report: Report,
) -> StrandDepths:
    """Depth of every vertex of `traced`.

    `alpha` (H, W): how much hair a pixel holds; `solid` (H, W) bool: face and body, which may hide hair.
    `depth_strokes` (H, W) float: metres towards the camera from the head's centre where the user marked a depth, NaN
    elsewhere. Raises `InputError` where shapes do not fit, `NoHairError` where no pixel is mostly hair.
    """
    shape = alpha.shape
    if depth_strokes is not None and np.shape(depth_strokes) != shape:
        raise InputError(f"depth_strokes has shape {np.shape(depth_strokes)}; {shape} was expected.")
    if solid.shape != shape:
        raise InputError(f"solid has shape {solid.shape}; {shape} was expected.")
    if not (alpha > HAIR_ALPHA).any():
        raise NoHairError("No pixel is mostly hair; there is nothing to reconstruct.")
    every = max(params.every, -(-len(traced.points) // params.unknowns))
    keep, offsets = _thinned(traced.offsets, every)
    points = np.asarray(traced.points, np.float64)[keep]
    occluded = np.asarray(traced.occluded, np.bool_)[keep]
    (under, over), envelope = together(
        lambda: _crossings(points, offsets, occluded, radius=params.neighbour_radius_px),
        lambda: hair_envelope(alpha > HAIR_ALPHA, solid, head=head, voxel=params.voxel),
    )
    target, weight = _constraints(points, envelope, head.xy_from_view, shape, params, depth_strokes)
    near = fields.neighbours(
        points,
        offsets=offsets,
        occluded=occluded,
        radius=params.neighbour_radius_px,
        max_angle=params.neighbour_angle,
        most=params.neighbour_count,
    )
    found = _solved(target, weight, offsets, near, target, params)
    allowed, held = np.full(len(points), np.inf), np.zeros(len(points), np.bool_)
    for _ in range(params.layer_rounds):
        allowed[under] = found.z[over] - params.layer_gap
        violated = found.z > allowed
        if not violated.any():
            break
        held |= violated
        goal = np.where(held, allowed, target)
        found = _solved(goal, np.where(held, params.depth_weight, weight), offsets, near, found.z, params)
    report.number("vertices", len(traced.points))
    report.number("unknowns", len(points))
    report.number("iterations", found.iterations)
    report.number("converged", found.converged)
    if not found.converged:
        report.warn(f"the depth did not converge; its relative residual is {found.residual:.1e}.")
    z = np.interp(np.arange(len(traced.points)), keep, found.z) if len(keep) else np.zeros(0)
    return StrandDepths(z.astype(np.float32), envelope, found.iterations, found.converged, found.residual)


def _solved(
    target: Array, weight: Array, offsets: Array, near: fields.Neighbours, start: Array, params: DepthParams
) -> fields.Depths:
    return fields.strand_depths(
        target,
        weight=weight,
        offsets=offsets,
        near=near,
        start=start,
        strand_weight=params.strand_weight,
        neighbour_weight=params.neighbour_weight,
        accuracy=params.accuracy,
        max_iterations=params.max_iterations,
    )


def _thinned(offsets: Array, every: int) -> tuple[Array, Array]:
    """Numbers of the vertices kept, both ends of each strand among them, and their offsets."""
    first, last = np.asarray(offsets[:-1]), np.asarray(offsets[1:]) - 1
    count = np.maximum((last - first + every - 1) // every, 1) + 1
    starts = np.concatenate([[0], np.cumsum(count)])
    place = np.arange(starts[-1]) - np.repeat(starts[:-1], count)
    part = place / np.repeat(count - 1, count)
    keep = np.repeat(first, count) + np.rint(part * np.repeat(last - first, count)).astype(np.int64)
    return keep, starts.astype(np.int64)


def _constraints(
    points: Array,
    envelope: Envelope,
    xy_from_view: Array,
    shape: tuple[int, int],
    params: DepthParams,
    strokes: Array | None,
) -> tuple[Array, Array]:
    """z̄ and w_Z of every vertex."""
    box = envelope.box
    reach = max(1.0, params.known_band / box.size)
    edge = fields.distance((~envelope.hair)[None])[0] <= reach
    known = (edge | envelope.head.seen) & envelope.hair
    surface = pixels_from_columns(spread(envelope.front, envelope.hair), box, xy_from_view, shape=shape)
    held = pixels_from_columns(known, box, xy_from_view, shape=shape)
    column, row = (np.clip(points[:, k].astype(int), 0, shape[1 - k] - 1) for k in (0, 1))
    target = surface[row, column].astype(np.float64)
    weight = np.maximum(params.depth_weight * np.clip(held[row, column], 0, 1), params.envelope_weight)
    if strokes is not None:
        given = np.asarray(strokes, np.float64)[row, column]
        marked = np.isfinite(given)
        target = np.where(marked, given, target)
        weight = np.where(marked, 10 * params.depth_weight, weight)
    return target, weight.astype(np.float64)


def _crossings(points: Array, offsets: Array, occluded: Array, *, radius: float) -> tuple[Array, Array]:
    """Numbers of occluded vertices, and of the nearest vertex in plain view of *another* strand, within `radius` px."""
    hidden, seen = np.nonzero(occluded)[0], np.nonzero(~occluded)[0]
    if len(hidden) == 0 or len(seen) == 0:
        return hidden[:0], seen[:0]
    strand = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    distance, found = KDTree(points[seen]).query(points[hidden], k=_CANDIDATES, distance_upper_bound=radius)
    over = seen[np.minimum(found, len(seen) - 1)]
    other = np.isfinite(distance) & (strand[over] != strand[hidden][:, None])
    crossed = other.any(axis=1)
    nearest = np.take_along_axis(over, other.argmax(axis=1)[:, None], axis=1)[:, 0]
    return hidden[crossed], nearest[crossed]
