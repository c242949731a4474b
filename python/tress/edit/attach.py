"""Strips on a surface: a copy on every chosen triangle."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.edit.fresh_names import FreshNames
from tress.edit.selection import editable_strips, refuse_locked
from tress.edit.variation import Variation, drawn, varied
from tress.model.attachment import Attachment, surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.group import Group
from tress.model.mesh import Mesh
from tress.model.record import Record
from tress.model.root_frames import RootFrames, triangle_frames

Array = np.ndarray[Any, Any]

DOWN = (0.0, -1.0, 0.0)
MIDDLE = (1 / 3, 1 / 3, 1 / 3)


def attach(
    document: Document,
    *,
    names: Iterable[str],
    surface: str,
    triangles: Any,
    into: str,
    barycentric: Any = MIDDLE,
    flow: Any = DOWN,
    variation: Variation | None = None,
    seed: int = 0,
) -> Diff:
    """A copy of the strips on each of the triangles, in the group `into`, which is made where it is absent.

    The strips are patterns, drawn about the origin: x along the flow, y across, z out of the surface; they stay as they
    are. `triangles` (T,) may name a triangle several times; `barycentric` is a place for all or (T, 3) for each. `flow`
    is a vector field on the surface, one vector for all or (V, 3) for its vertices: its part in the plane of the
    triangle turns the copy. `variation` makes copies differ (a location moves the root along the triangle's plane).
    Raises `InputError` for triangles outside the surface or its scalp (where it has a mask of that name), and where a
    strip or the group is locked.
    """
    mesh = surface_mesh(document, surface, where=f"The group {into!r}")
    chosen = checked_triangles(mesh, triangles, surface=surface)
    places = np.broadcast_to(np.asarray(barycentric, np.float64), (len(chosen), 3))
    frames = triangle_frames(mesh, triangle=chosen, barycentric=places)
    angle = _flow_angles(mesh, chosen, places, frames, flow)
    patterns = editable_strips(document, names)
    added: dict[str, Record] = {}
    if into in document.records:
        refuse_locked(document, [into])
    else:
        added[into] = Group()
    rng, fresh, change = np.random.default_rng(seed), FreshNames(document, taken=[into]), variation or Variation()
    for triangle, place, turn in zip(chosen, places, angle, strict=True):
        cosine, sine = np.cos(turn), np.sin(turn)
        rotation = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
        for name, pattern in patterns.items():
            own = drawn(change, rng, shape=pattern.weights.shape)
            copy = varied(pattern, own)
            offset = np.append(own.location_m, 0.0)
            root = Attachment(surface=surface, triangle=int(triangle), barycentric=place, offset=offset)
            added[fresh.next(name)] = replace(copy, points=copy.points @ rotation.T, root=root, group=into)
    Document({**document.records, **added})
    return Diff(added=added)


def checked_triangles(mesh: Mesh, triangles: Any, *, surface: str) -> Array:
    """(T,) int64 triangles of a surface. Raises `InputError` where one is absent or outside the scalp."""
    found = np.asarray(triangles)
    if found.ndim != 1 or (found.size and found.dtype.kind not in "iu"):
        raise InputError(f"Triangles are whole numbers (T,); {triangles!r} is not.")
    wrong = found[(found < 0) | (found >= len(mesh.triangles))] if found.size else found
    if len(wrong):
        raise InputError(f"Triangle {wrong[0]} is not one of {surface!r}; 0 to {len(mesh.triangles) - 1} was expected.")
    chosen = found.astype(np.int64)
    scalp = mesh.vertex_attributes.get("scalp")
    if scalp is not None and chosen.size:
        outside = chosen[(scalp[mesh.triangles[chosen]] <= 0).all(axis=1)]
        if len(outside):
            raise InputError(f"Triangle {outside[0]} lies outside the scalp of {surface!r}.")
    return chosen


def _flow_angles(mesh: Mesh, triangles: Array, barycentric: Array, frames: RootFrames, flow: Any) -> Array:
    """(T,) angle of the flow from the x axis of each frame; 0 where it is perpendicular to the triangle."""
    field = np.asarray(flow, np.float64)
    if field.shape not in ((3,), (len(mesh.positions), 3)) or not np.isfinite(field).all():
        raise InputError(f"A flow has shape {field.shape}; (3,) or ({len(mesh.positions)}, 3) was expected.")
    vectors = np.broadcast_to(field, mesh.positions.shape)[mesh.triangles[triangles]]
    at_root = np.einsum("tk,tkd->td", barycentric, vectors)
    x, y = (np.einsum("td,td->t", at_root, frames.axes[:, :, axis]) for axis in (0, 1))
    return np.arctan2(y, x)
