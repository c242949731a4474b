"""Clumps: a profile swept along key hairs, as closed NURBS surfaces."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.kernel.arrays import checked
from tress.kernel.curves import uniform_knots
from tress.kernel.nurbs import Patch
from tress.methods.cartoon.frames import frames
from tress.methods.cartoon.key_hairs import KeyHairs
from tress.methods.cartoon.params import ClumpParams
from tress.methods.cartoon.profile import Profile, alike, ellipse

Array = np.ndarray[Any, Any]

DEGREE = 3
LEAST_SCALE = 1e-4
"""A tip keeps this part of its radius: a ring of one point has no normal to shade."""


@dataclass(frozen=True, eq=False)
class ClumpShape:
    """What may be drawn of a clump beyond its parameters.

    `root` and `tip`: profiles; where they differ, one turns into the other on the way. `tip_shape` (K, 2): how the
    taper goes, from (0, 1) where it starts to (1, 0) at the tip: part of the taper, part of the radius. `radii` (K,):
    factors of both radii at even places from root to tip.
    """

    root: Profile = field(default_factory=ellipse)
    tip: Profile | None = None
    tip_shape: Any = ((0.0, 1.0), (1.0, 0.0))
    radii: Any = (1.0,)


def clumps(hairs: KeyHairs, *, params: ClumpParams = ClumpParams(), shape: ClumpShape = ClumpShape()) -> list[Patch]:
    """One closed surface for every key hair: u along it, v round it, normals outwards.

    Ring i of control points lies about the hair's control point i, moved by the radii along N and R; the last part
    `pointiness` of the length tapers. A flat end is closed by a lid with a sharp edge, and so is the root.
    Raises `InputError` for a tip shape or radii that are no numbers >= 0.
    Source: Modelling and Animating Cartoon Hair, section 3, Hair Clump Geometry, and Table 1.
    """
    found = frames(hairs.points, normals=hairs.normals)
    count = hairs.points.shape[1]
    part = np.linspace(0, 1, count)
    scale = _scale(part, params, shape)
    rings, weights, knots, degree = _rings(part, shape)
    sideways = params.horizontal_radius * scale[:, None] * rings[..., 0]
    upwards = params.vertical_radius * scale[:, None] * rings[..., 1]
    nets = (
        hairs.points[:, :, None]
        + sideways[None, ..., None] * found.across[:, :, None]
        + upwards[None, ..., None] * found.normal[:, :, None]
    )
    return [_closed(net, weights, knots, degree, flat_tip=scale[-1] > LEAST_SCALE) for net in nets]


def _scale(part: Array, params: ClumpParams, shape: ClumpShape) -> Array:
    """(p,) part of the radii at every control point."""
    radii = checked(shape.radii, name="radii", dtype=np.float64, shape=(None,))
    curve = checked(shape.tip_shape, name="tip_shape", dtype=np.float64, shape=(None, 2))
    if not len(radii) or radii.min() < 0 or not len(curve) or curve.min() < 0:
        raise InputError("radii and tip_shape hold a number below 0, or none; parts of 0 or more were expected.")
    if len(curve) > 1 and (np.diff(curve[:, 0]) < 0).any():
        raise InputError("tip_shape goes back; places that rise from 0 to 1 were expected.")
    along = np.interp(part, np.linspace(0, 1, max(len(radii), 2)), np.resize(radii, max(len(radii), 2)))
    if params.pointiness == 0:
        return along
    into = np.clip((part - (1 - params.pointiness)) / params.pointiness, 0, 1)
    return along * np.maximum(np.interp(into, *curve.T), LEAST_SCALE)


def _rings(part: Array, shape: ClumpShape) -> tuple[Array, Array, Array, int]:
    """Control points (p, Q, 2) of the profile at every place, with weights (Q,), knots and degree; clockwise, so that
    along x round is outwards."""
    root, tip = (shape.root, shape.root) if shape.tip is None else alike(shape.root, shape.tip)
    mixed = root.points + part[:, None, None] * (tip.points - root.points)
    return mixed[:, ::-1], root.weights[::-1], -root.knots[::-1], root.degree


def _closed(net: Array, ring_weights: Array, knots_v: Array, degree_v: int, *, flat_tip: bool) -> Patch:
    """The swept surface with lids: rows of control points that go from the ring to its middle behind a sharp edge."""
    inwards = np.arange(1, DEGREE + 1)[:, None, None] / DEGREE

    def lid(ring: Array) -> Array:
        middle = ring[:-1].mean(axis=0) if degree_v < DEGREE else ring[:-DEGREE].mean(axis=0)
        return ring + inwards * (middle - ring)

    rows = [lid(net[0])[::-1], net] + ([lid(net[-1])] if flat_tip else [])
    inner = uniform_knots(len(net), degree=DEGREE)[DEGREE + 1 : -DEGREE - 1]
    ends = ([-0.1], [1.1] if flat_tip else [])
    knots = np.concatenate(
        [np.repeat(ends[0], DEGREE + 1), [0] * DEGREE, inner, [1] * (DEGREE if flat_tip else DEGREE + 1)]
        + ([np.repeat(ends[1], DEGREE + 1)] if flat_tip else [])
    )
    points = np.concatenate(rows)
    weights = np.tile(ring_weights, (len(points), 1))
    return Patch(points, weights, knots, knots_v, DEGREE, degree_v)
