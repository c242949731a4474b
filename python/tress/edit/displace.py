"""Displacing control points: one or several, alone or with what is near."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from scipy.spatial import KDTree

from tress.base.errors import InputError
from tress.edit.move_points import moved
from tress.edit.selection import editable_strips
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.strip_axes import strip_axes
from tress.model.strip_set import StripSet, resting_points, strip_set

Array = np.ndarray[Any, Any]

FRAMES = ("world", "head", "root", "strip")


def displace(
    document: Document,
    *,
    points: Mapping[str, Any],
    by: Any,
    frame: str = "world",
    falloff_m: float = 0.0,
    others: Iterable[str] = (),
) -> Diff:
    """Moves control points of strips, metres.

    `points` names the control points, (K, 2) whole numbers (row from the root, column) for each strip; `by` is how far:
    (3,) for all, or (K, 3) for each strip by name. `frame` says along which axes: those of the head frame (`world` and
    `head`, the same in a document), of the strip's root (`root`; see `Attachment`) or of the strip itself (`strip`:
    along, across, normal at its root). Within `falloff_m` of a moved point, the other points of the same strips and
    those of `others` go with the nearest one, less and less.
    Raises `InputError` for points that a strip does not have, and where a strip is locked.
    """
    if frame not in FRAMES:
        raise InputError(f"Frame {frame!r}: one of {', '.join(FRAMES)} was expected.")
    if not 0 <= falloff_m < np.inf:
        raise InputError(f"A falloff of {falloff_m} m: 0 or more was expected.")
    names = list(editable_strips(document, [*points, *others]))
    if unknown := set(points) - set(names):
        raise InputError(f"Record {min(unknown)!r} is a group; control points belong to strips.")
    strips = strip_set(document, names)
    picked, shift = _picked(strips, points, by, frame)
    return moved(strips, _spread(strips, picked, shift, falloff_m))


def _picked(strips: StripSet, points: Mapping[str, Any], by: Any, frame: str) -> tuple[Array, Array]:
    """Rows of the strip set, and how far they move in the head frame."""
    rows, shifts = [], []
    for name, indices in points.items():
        index = strips.names.index(name)
        places = _places(name, indices, tuple(strips.shapes[index]))
        rows.append(strips.offsets[index] + places)
        vectors = _vectors(name, by[name] if isinstance(by, Mapping) else by, len(places))
        shifts.append(vectors @ _axes(strips, index, frame).T)
    if not rows:
        return np.zeros(0, np.int64), np.zeros((0, 3))
    return np.concatenate(rows), np.concatenate(shifts)


def _places(name: str, indices: Any, shape: tuple[int, ...]) -> Array:
    found = np.asarray(indices)
    if found.ndim != 2 or found.shape[1] != 2 or found.dtype.kind not in "iu":
        raise InputError(f"Control points of {name!r} are (K, 2) whole numbers; {indices!r} is not.")
    if found.size and ((found < 0) | (found >= shape)).any():
        wrong = found[int(np.argmax(((found < 0) | (found >= shape)).any(axis=1)))]
        raise InputError(f"Strip {name!r} has {shape[0]} x {shape[1]} control points; {tuple(wrong.tolist())} is none.")
    return found[:, 0] * shape[1] + found[:, 1]


def _vectors(name: str, by: Any, count: int) -> Array:
    found = np.asarray(by, np.float64)
    if found.shape not in ((3,), (count, 3)) or not np.isfinite(found).all():
        raise InputError(f"Displacement {by!r} of {name!r}: three numbers, or three for each of {count} points.")
    return np.broadcast_to(found, (count, 3))


def _axes(strips: StripSet, index: int, frame: str) -> Array:
    """The columns are the axes, in the head frame."""
    if frame in ("world", "head"):
        return np.eye(3)
    if frame == "root":
        return strips.frames.axes[index]
    return strip_axes(strips.nets(resting_points(strips))[index])


def _spread(strips: StripSet, picked: Array, shift: Array, falloff_m: float) -> Array:
    """(N, 3) how far every point moves: those picked all the way, those near them less with the distance."""
    result = np.zeros((len(strips.points), 3))
    if falloff_m > 0 and len(picked):
        places = resting_points(strips)
        found = KDTree(places[picked]).query(places, distance_upper_bound=falloff_m)
        distance, nearest = np.asarray(found[0]), np.asarray(found[1])
        near = np.isfinite(distance)
        share = (1 - (distance[near] / falloff_m) ** 2) ** 2
        result[near] = share[:, None] * shift[nearest[near]]
    result[picked] = shift
    return result
