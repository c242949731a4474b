"""What other programs should see of records whose place depends on the rest of the document.

A strip's own prim holds its record; within it lie the patch in the head frame, at rest and at sampled times, and the
mesh. A group's prim holds one mesh of its strips. None of it is read back.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tress.io.usd.extent import extent
from tress.io.usd.patch import patch_prim
from tress.io.usd.prim import Attribute, Prim
from tress.io.usd.stage import FRAMES_PER_SECOND
from tress.io.usd.surface import mesh_prim
from tress.model.document import Document
from tress.model.group import Group, lineage
from tress.model.keyframes import Keyframes
from tress.model.record import Record
from tress.model.strip import Strip
from tress.model.strip_grid import strip_grid
from tress.model.strip_mesh import strips_mesh
from tress.model.strip_set import posed_points, strip_set
from tress.model.strips import visible_strips

Array = np.ndarray[Any, Any]

MOST_SAMPLES = 240  # ten seconds; longer motions are sampled more sparsely
INVISIBLE = {"visibility": Attribute("token", "invisible")}


def shown_prims(name: str, record: Record, document: Document) -> tuple[Prim, ...]:
    """The prims that show the record `name` of a document; empty for records that show themselves."""
    shown = SHOWN.get(type(record))
    return shown(name, record, document) if shown else ()


def sample_times(document: Document, *, group: str, strip: str = "") -> list[float]:
    """The times (seconds) at which a strip of `group`, or the group, is sampled: every frame, and every keyframe."""
    targets = {strip, *lineage(document, group)}
    moving = [item for item in document.of_type(Keyframes).values() if item.target in targets]
    if not moving:
        return []
    moments = np.concatenate([item.times for item in moving])
    first, last = np.floor(moments.min() * FRAMES_PER_SECOND), np.ceil(moments.max() * FRAMES_PER_SECOND)
    frames = np.linspace(first, last, int(min(last - first + 1, MOST_SAMPLES))) / FRAMES_PER_SECOND
    return np.unique(np.concatenate([frames, moments])).tolist()


def _strip_prims(name: str, strip: Strip, document: Document) -> tuple[Prim, ...]:
    strips = strip_set(document, [name])
    times = sample_times(document, group=strip.group, strip=name)
    samples = {time: strips.nets(posed_points(strips, time))[0] for time in times}
    patch = patch_prim("patch", strip, strips.nets(posed_points(strips))[0], samples=samples)
    if name not in visible_strips(document, group=strip.group):
        patch = replace(patch, attributes={**patch.attributes, **INVISIBLE})
        return (patch,)
    return (patch,) if strip.group else (patch, _mesh_prim(document, [name], times))


def _group_prims(name: str, _: Group, document: Document) -> tuple[Prim, ...]:
    names = visible_strips(document, group=name)
    if not names:
        return ()
    moving = {time for strip in names for time in sample_times(document, group=name, strip=strip)}
    return (_mesh_prim(document, names, sorted(moving)),)


def _mesh_prim(document: Document, names: list[str], times: list[float]) -> Prim:
    prim = mesh_prim("mesh", strips_mesh(document, names=names))
    strips = strip_set(document, names)
    grid = strip_grid(strips.records)
    positions = {time: grid.points(posed_points(strips, time)).astype(np.float32) for time in times}
    boxes = {time: np.asarray(extent(found).value) for time, found in positions.items()}
    attributes = {
        **prim.attributes,
        "doubleSided": Attribute("bool", True, uniform=True),
        "points": replace(prim.attributes["points"], samples=positions),
        "extent": replace(prim.attributes["extent"], samples=boxes),
    }
    return replace(prim, attributes=attributes, data={})


SHOWN: Mapping[type[Record], Callable[[str, Any, Document], tuple[Prim, ...]]] = {
    Strip: _strip_prims,
    Group: _group_prims,
}
