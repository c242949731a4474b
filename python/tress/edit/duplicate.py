"""Copies of strips, like their originals or varied."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from tress.base.errors import InputError
from tress.edit.copied_motion import CopiedMotion
from tress.edit.fresh_names import FreshNames
from tress.edit.placing import slid
from tress.edit.selection import editable_strips
from tress.edit.variation import Drawn, Variation, drawn, varied
from tress.model.attachment import surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.record import Record
from tress.model.root_frames import root_frames
from tress.model.strip import Strip
from tress.model.strip_axes import strip_axes


def duplicate(
    document: Document,
    *,
    names: Iterable[str],
    count: int = 1,
    variation: Variation | None = None,
    seed: int = 0,
    into: str = "",
) -> Diff:
    """`count` copies of every strip, in the group `into` (which is there) or in that of the original.

    Copies take over everything but a lock, motion too. `variation` says how they differ; each draws
    numbers of its own, and the same `seed` draws the same. A location moves an attached root over its surface, and the
    strip turns as the surface does; others move in the plane of their root. Raises `InputError` where a name is no
    strip or group or is locked, and where `count` is below 1.
    """
    if count < 1:
        raise InputError(f"{count} copies; at least 1 was expected.")
    originals = editable_strips(document, names)
    rng, change = np.random.default_rng(seed), variation or Variation()
    fresh = FreshNames(document)
    copies = {
        fresh.next(name): (name, drawn(change, rng, shape=strip.weights.shape))
        for _ in range(count)
        for name, strip in originals.items()
    }
    added = _placed(document, originals, copies, fresh)
    if into:
        added |= {name: replace(item, group=into) for name, item in added.items() if isinstance(item, Strip)}
    Document({**document.records, **added})  # refuses a group that is not there
    return Diff(added=added)


def _placed(
    document: Document, originals: Mapping[str, Strip], copies: Mapping[str, tuple[str, Drawn]], fresh: FreshNames
) -> dict[str, Record]:
    """The copies, varied in shape and place, and their motions."""
    motions, added = CopiedMotion(document, fresh), {}
    attached: dict[str, list[str]] = {}
    for name, (original, change) in copies.items():
        strip = replace(varied(originals[original], change), locked=False)
        if strip.root is not None and change.location_m.any():
            attached.setdefault(strip.root.surface, []).append(name)
            added[name] = strip
            continue
        shift = np.zeros(3)
        if change.location_m.any():
            shift = strip_axes(originals[original].points)[:, :2] @ change.location_m
        added[name] = replace(strip, points=strip.points + shift)
        added |= motions.of(original, copy=name, shift=shift)
    for surface, chosen in attached.items():
        mesh = surface_mesh(document, surface, where="A strip")
        roots = [strip.root for strip in (added[name] for name in chosen) if strip.root is not None]
        frames = root_frames(document, roots)
        shifts = np.array([copies[name][1].location_m for name in chosen])
        for name, (root, turn) in zip(chosen, slid(mesh, roots, frames, shifts), strict=True):
            added[name] = replace(added[name], root=root, points=added[name].points @ turn.T)
            added |= motions.of(copies[name][0], copy=name, in_root=turn)
    return added
