"""Combing: strips that follow a flow over a surface and beyond it."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import BSpline

from tress.base.errors import InputError
from tress.edit.move_points import moved
from tress.edit.selection import editable_strips
from tress.edit.surface_distance import distances, skin
from tress.model.attachment import surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.mesh import Mesh
from tress.model.strip import Strip
from tress.model.strip_axes import strip_axes
from tress.model.strip_set import resting_points, strip_set

Array = np.ndarray[Any, Any]
Flow = Callable[[Array], Array]
"""Directions (N, 3) of any length at points (N, 3), both in the head frame."""

STEP_M = 0.008
CLING_M = 0.01
"""So far from the surface strips that cling to it head back as much as on."""
NEAR_M = 0.04
"""Up to so far from the surface strips turn their face away from it."""


def comb(
    document: Document,
    *,
    names: Iterable[str],
    surface: str,
    flow: Flow,
    lift_m: float = 0.004,
    rise_m: float = 0.02,
    bend_m: float = 0.02,
    cling: float = 0.0,
) -> Diff:
    """Lays strips along a flow: each leaves its root as it does now and turns into the flow over a length of `bend_m`.

    On its way it slides over the surface, `lift_m` above it from `rise_m` behind the root on, and faces away from it.
    What the strip was along its own axis it becomes along that path: its length, its widths, its waves and its curl
    stay. The root row does not move. The flow may lead into the surface, as gravity does on top of a head; where it
    leads away, `cling` says how far strips stay at the surface all the same: 0 not at all, 1 as short or tied hair.
    Raises `InputError` where the surface is no `Head` or `Mesh`, the flow gives no directions, a length is not
    positive, a strip has no length or width, or is locked. About 1 s for 300 strips of 30 cm.
    """
    if not (0 <= lift_m < np.inf and 0 < rise_m < np.inf and 0 < bend_m < np.inf):
        raise InputError(f"A lift of {lift_m} m after {rise_m} m and a bend of {bend_m} m are none.")
    if not 0 <= cling <= 1:
        raise InputError(f"A cling of {cling}; 0 to 1 was expected.")
    mesh = skin(surface_mesh(document, surface, where="A strip"))
    strips = strip_set(document, list(editable_strips(document, names)))
    if not strips.names:
        return Diff()
    nets = strips.nets(resting_points(strips))
    axes = np.stack([strip_axes(net) for net in nets])
    roots = np.stack([net[0].mean(axis=0) for net in nets])
    own = [(net - root) @ frame for net, root, frame in zip(nets, roots, axes, strict=True)]
    lengths = np.array([max(net[..., 0].max(), STEP_M) for net in own])
    paths = _paths(mesh, roots, axes, lengths, flow, lift_m=lift_m, rise_m=rise_m, bend_m=bend_m, cling=cling)
    fits: dict[tuple[bytes, ...], Array] = {}
    shifts = [
        _along_path(record, net, paths, index, fits) - before
        for index, (record, net, before) in enumerate(zip(strips.records, own, nets, strict=True))
    ]
    return moved(strips, np.concatenate([shift.reshape(-1, 3) for shift in shifts]))


@dataclass(frozen=True, eq=False)
class _Paths:
    """S paths of K points each in even steps: `points` (S, K, 3), `frames` (S, K, 3, 3) with the columns along, across
    and normal, `step` (S,) metres."""

    points: Array
    frames: Array
    step: Array

    def at(self, path: int, place: Array) -> tuple[Array, Array]:
        """Points (..., 3) and frames (..., 3, 3) at `place` (...) metres from the root; straight on beyond the ends."""
        step, last = self.step[path], self.points.shape[1] - 1
        low = np.clip(np.floor(place / step).astype(np.int64), 0, last - 1)
        share = (place / step - low)[..., None]
        points = self.points[path, low] * (1 - share) + self.points[path, low + 1] * share
        share = np.clip(share, 0, 1)[..., None]
        return points, self.frames[path, low] * (1 - share) + self.frames[path, low + 1] * share


def _paths(
    mesh: Mesh,
    roots: Array,
    axes: Array,
    lengths: Array,
    flow: Flow,
    *,
    lift_m: float,
    rise_m: float,
    bend_m: float,
    cling: float,
) -> _Paths:
    """Where hair goes from its root: with its momentum, the flow, and the surface in the way."""
    count = max(2, int(np.ceil(lengths.max() / STEP_M)))
    step = lengths / count
    turn = (1 - np.exp(-step / bend_m))[:, None]
    here, along, normal = roots, axes[:, :, 0], axes[:, :, 2]
    start, outwards = distances(mesh, roots)
    resting, away = np.ones(len(roots), bool), np.zeros(len(roots))
    points, frames = [here], [axes]
    for index in range(1, count + 1):
        wanted = _held(_unit(_directions(flow, here)), outwards, away, cling)
        into = np.minimum(np.einsum("ni,ni->n", wanted, outwards), 0) * resting
        along = _unit(along * (1 - turn) + (wanted - into[:, None] * outwards) * turn)
        distance, outwards = distances(mesh, here + step[:, None] * along)
        lift = start + (lift_m - start) * np.clip(index * step / rise_m, 0, 1)
        missing = np.maximum(lift - distance, 0)
        resting, away = missing > 0, distance - lift
        along = _unit(step[:, None] * along + missing[:, None] * outwards)
        here = here + step[:, None] * along
        near = np.clip(1 - distance / NEAR_M, 0.02, 1)[:, None] * turn
        normal = _across(normal * (1 - near) + outwards * near, along)
        points.append(here)
        frames.append(np.stack([along, np.cross(normal, along), normal], axis=2))
    return _Paths(np.stack(points, axis=1), np.stack(frames, axis=1), step)


def _held(wanted: Array, outwards: Array, away: Array, cling: float) -> Array:
    """Directions (S, 3) without what leads outwards, and back to a surface that is `away` (S,) metres too far."""
    if not cling:
        return wanted
    back = np.clip(away / CLING_M, 0, 1) * np.clip(2 - away / NEAR_M, 0, 1)
    leaving = np.maximum(np.einsum("ni,ni->n", wanted, outwards), 0) + back
    return _unit(wanted - (cling * leaving)[:, None] * outwards)


def _along_path(strip: Strip, own: Array, paths: _Paths, index: int, fits: dict[tuple[bytes, ...], Array]) -> Array:
    """(U, V, 3) control points of the strip bent along its path: as many points of the surface go where they belong."""
    key = (strip.knots_u.tobytes(), strip.knots_v.tobytes(), strip.weights.tobytes())
    if key not in fits:
        fits[key] = _surface_weights(strip)
    weights = fits[key]
    on_surface = weights @ own.reshape(-1, 3)
    points, frames = paths.at(index, on_surface[:, 0])
    aside = on_surface * [0, 1, 1]
    wanted = points + np.einsum("nij,nj->ni", frames, aside)
    net = np.linalg.lstsq(weights, wanted, rcond=None)[0].reshape(own.shape)
    root, frame = paths.points[index, 0], paths.frames[index, 0]
    net[0] = root + own[0] @ frame.T
    return net


def _surface_weights(strip: Strip) -> Array:
    """(U V, U V) weights of the control points in the points of the surface at the Greville parameters."""
    along, across = (
        BSpline.design_matrix(_greville(knots, degree), knots, degree).toarray()
        for knots, degree in zip((strip.knots_u, strip.knots_v), strip.degrees, strict=True)
    )
    weights = np.kron(along, across) * strip.weights.ravel()
    return weights / weights.sum(axis=1, keepdims=True)


def _greville(knots: Array, degree: int) -> Array:
    """One parameter for each control point: where its share is about the greatest."""
    count = len(knots) - degree - 1
    means = np.array([knots[index + 1 : index + degree + 1].mean() for index in range(count)])
    return np.clip(means, knots[degree], knots[count])


def _directions(flow: Flow, points: Array) -> Array:
    found = np.asarray(flow(points), np.float64)
    if found.shape != points.shape or not np.isfinite(found).all():
        raise InputError(
            f"The flow gave shape {found.shape} at {points.shape}; as many finite directions belong there."
        )
    return found


def _across(vectors: Array, along: Array) -> Array:
    """Unit vectors perpendicular to `along`."""
    return _unit(vectors - np.einsum("ni,ni->n", vectors, along)[:, None] * along)


def _unit(vectors: Array) -> Array:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True).clip(1e-12)
