"""Mirror images of strips."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.edit.copied_motion import CopiedMotion
from tress.edit.fresh_names import FreshNames
from tress.edit.placing import nearest_frames
from tress.edit.selection import editable_strips
from tress.kernel.curves import reversed_knots
from tress.model.attachment import Attachment, surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.knots import domain_of
from tress.model.record import Record
from tress.model.root_frames import root_frames
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]


def mirror(
    document: Document, *, names: Iterable[str], normal: Any = (1, 0, 0), distance_m: float = 0.0, into: str = ""
) -> Diff:
    """The mirror image of every strip in the plane with this normal, `distance_m` from the origin of the head frame.

    Images are in the group `into` (which is there) or in that of the original, are rooted on the nearest point of the
    same surface, move as the originals do, and face outwards like them: their columns run the other way.
    Raises `InputError` where a name is no strip or group or is locked, and where the normal has no length.
    """
    axis = np.asarray(normal, np.float64)
    if axis.shape != (3,) or not np.isfinite([*axis, distance_m]).all() or not np.linalg.norm(axis) > 0:
        raise InputError(f"The plane with normal {normal!r} and distance {distance_m} is none.")
    axis = axis / np.linalg.norm(axis)
    flip, shift = np.eye(3) - 2 * np.outer(axis, axis), 2 * distance_m * axis
    originals = editable_strips(document, names)
    fresh = FreshNames(document)
    motions, added = CopiedMotion(document, fresh), dict[str, Record]()
    for name, strip in originals.items():
        image, turn, offset = _image(document, strip, flip, shift)
        key = fresh.next(name)
        added[key] = replace(image, group=into or strip.group, locked=False)
        added |= motions.of(name, copy=key, in_root=turn, in_head=flip, shift=offset, mirrored=True)
    Document({**document.records, **added})
    return Diff(added=added)


def _image(document: Document, strip: Strip, flip: Array, shift: Array) -> tuple[Strip, Array, Array]:
    """The image, and what takes control points of the strip to those of the image: a matrix and a shift."""
    root, turn, offset = strip.root, flip, shift
    if strip.root is not None:
        old = root_frames(document, [strip.root])
        mesh = surface_mesh(document, strip.root.surface, where="A strip")
        origin = flip @ old.origins[0] + shift
        triangle, barycentric, new = nearest_frames(mesh, origin[None])
        root = Attachment(
            surface=strip.root.surface,
            triangle=int(triangle[0]),
            barycentric=barycentric[0] / barycentric[0].sum(),
            offset=new.axes[0].T @ (origin - new.origins[0]),
        )
        turn, offset = new.axes[0].T @ flip @ old.axes[0], np.zeros(3)
    image = replace(
        strip,
        points=(strip.points @ turn.T + offset)[:, ::-1],
        weights=strip.weights[:, ::-1],
        knots_v=reversed_knots(strip.knots_v, *domain_of(strip.knots_v, count=strip.weights.shape[1])),
        root=root,
    )
    return image, turn, offset
