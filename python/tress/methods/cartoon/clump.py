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


@dataclass(frozen=True, eq=False)
class Swept:
    """n clumps of one make: `points` (n, U, V, 3) float64, and what they share: `weights` (U, V), knots, degrees."""

    points: Array
    weights: Array
    knots_u: Array
    knots_v: Array
    degree_u: int
    degree_v: int

    def patches(self) -> list[Patch]:
        """One surface for every clump."""
        shared = (self.weights, self.knots_u, self.knots_v, self.degree_u, self.degree_v)
        return [Patch(net, *shared) for net in self.points]


def clumps(hairs: KeyHairs, *, params: ClumpParams = ClumpParams(), shape: ClumpShape = ClumpShape()) -> list[Patch]:
    """One closed surface for every key hair, as `swept` makes them."""
    return swept(hairs, params=params, shape=shape).patches()


def swept(
    hairs: KeyHairs,
    *,
    params: ClumpParams = ClumpParams(),
    shape: ClumpShape = ClumpShape(),
    radius: Array | float = 1.0,
    twist: Array | float = 0.0,
) -> Swept:
    """One closed surface for every key hair: u along it, v round it, normals outwards.

    Ring i of control points lies about the hair's control point i, moved by the radii along N and R; the last part
    `pointiness` of the length tapers. An end that is not pointed is closed by a lid with a sharp edge. Single hairs
    have factors of both radii, `radius` (n,), and turn about themselves by `twist` (n,) radians from root to tip.
    Raises `InputError` for a tip shape or radii that are no numbers >= 0.
    Source: Modelling and Animating Cartoon Hair, section 3, Hair Clump Geometry, and Table 1.
    """
    found = frames(hairs.points, normals=hairs.normals)
    part = np.linspace(0, 1, hairs.points.shape[1])
    scale = clump_scale(part, params=params, shape=shape)
    rings, ring_weights, knots_v, degree_v = _rings(part, shape)
    across, normal = _twisted(found.across, found.normal, np.asarray(twist, float)[..., None] * part)
    factor = np.asarray(radius, float)[..., None, None] * scale[:, None]
    sideways, upwards = params.horizontal_radius * rings[..., 0], params.vertical_radius * rings[..., 1]
    points = (factor * sideways)[..., None] * across[:, :, None] + (factor * upwards)[..., None] * normal[:, :, None]
    points += hairs.points[:, :, None]
    lids = (bool(scale[0] > LEAST_SCALE), bool(scale[-1] > LEAST_SCALE))
    nets, knots_u = _closed(points, degree_v, lids=lids)
    return Swept(nets, np.tile(ring_weights, (nets.shape[1], 1)), knots_u, knots_v, DEGREE, degree_v)


def _twisted(across: Array, normal: Array, angle: Array) -> tuple[Array, Array]:
    if not angle.any():
        return across, normal
    cos, sin = np.cos(angle)[..., None], np.sin(angle)[..., None]
    return cos * across + sin * normal, cos * normal - sin * across


def clump_scale(part: Array, *, params: ClumpParams, shape: ClumpShape = ClumpShape()) -> Array:
    """(p,) factor of both radii at parts (p,) of the length, from root to tip. Raises `InputError` as `swept` does."""
    radii = checked(shape.radii, name="radii", dtype=np.float64, shape=(None,))
    curve = checked(shape.tip_shape, name="tip_shape", dtype=np.float64, shape=(None, 2))
    if not len(radii) or radii.min() < 0 or not len(curve) or curve.min() < 0:
        raise InputError("radii and tip_shape hold a number below 0, or none; parts of 0 or more were expected.")
    if len(curve) > 1 and (np.diff(curve[:, 0]) < 0).any():
        raise InputError("tip_shape goes back; places that rise from 0 to 1 were expected.")
    along = np.interp(part, np.linspace(0, 1, max(len(radii), 2)), np.resize(radii, max(len(radii), 2)))
    along = np.maximum(along, LEAST_SCALE)
    if params.pointiness == 0:
        return along
    into = np.clip((part - (1 - params.pointiness)) / params.pointiness, 0, 1)
    return np.maximum(along * np.interp(into, *curve.T), LEAST_SCALE)


def _rings(part: Array, shape: ClumpShape) -> tuple[Array, Array, Array, int]:
    """Control points (p, Q, 2) of the profile at every place, with weights (Q,), knots and degree; clockwise, so that
    along x round is outwards."""
    root, tip = (shape.root, shape.root) if shape.tip is None else alike(shape.root, shape.tip)
    mixed = root.points + part[:, None, None] * (tip.points - root.points)
    return mixed[:, ::-1], root.weights[::-1], -root.knots[::-1], root.degree


def _closed(nets: Array, degree_v: int, *, lids: tuple[bool, bool]) -> tuple[Array, Array]:
    """Control points (n, U, V, 3) and knots along, with lids at the root and the tip where asked: rows that go from the
    ring to its middle behind a sharp edge."""
    inwards = np.arange(1, DEGREE + 1)[:, None, None] / DEGREE
    inner = uniform_knots(nets.shape[1], degree=DEGREE)[DEGREE + 1 : -DEGREE - 1]

    def lid(ring: Array) -> Array:
        middle = ring[:, : -(DEGREE if degree_v >= DEGREE else 1)].mean(axis=1, keepdims=True)
        return ring[:, None] + inwards * (middle - ring)[:, None]

    rows = [lid(nets[:, 0])[:, ::-1]] * lids[0] + [nets] + [lid(nets[:, -1])] * lids[1]
    knots = [[-0.1] * (DEGREE + 1) + [0] * DEGREE if lids[0] else [0] * (DEGREE + 1), inner]
    knots += [[1] * DEGREE + [1.1] * (DEGREE + 1) if lids[1] else [1] * (DEGREE + 1)]
    return np.concatenate(rows, axis=1), np.concatenate(knots).astype(np.float64)
