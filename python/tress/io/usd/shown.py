"""What other programs should see of records whose place depends on the rest of the document.

A strip's own prim holds its record; within it lie the patch in the head frame, at rest and at sampled times, and the
mesh. A group's prim holds one mesh of its strips. None of it is read back.
"""

from collections.abc import Iterable, Mapping
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
from tress.model.strip import Strip
from tress.model.strip_grid import strip_grid
from tress.model.strip_mesh import strips_mesh
from tress.model.strip_set import posed_points, strip_set
from tress.model.strips import visible_strips

Array = np.ndarray[Any, Any]

MOST_SAMPLES = 240  # ten seconds; longer motions are sampled more sparsely
INVISIBLE = {"visibility": Attribute("token", "invisible")}


def shown_prims(document: Document) -> Mapping[str, tuple[Prim, ...]]:
    """The prims that show the strips and groups of a document, by their names; other records show themselves.

    Strips that are sampled at the same times are posed together: 300 moving strips take as long as a few.
    """
    times = _times_of_strips(document)
    return {**_strip_prims(document, times), **_group_prims(document, times)}


def sample_times(document: Document, *, group: str, strip: str = "") -> list[float]:
    """The times (seconds) at which a strip of `group`, or the group, is sampled: every frame, and every keyframe."""
    targets = {strip, *lineage(document, group)}
    return list(_frames([item for item in document.of_type(Keyframes).values() if item.target in targets]))


def _times_of_strips(document: Document) -> dict[str, tuple[float, ...]]:
    """`sample_times` of all strips."""
    moving: dict[str, list[Keyframes]] = {}
    for item in document.of_type(Keyframes).values():
        moving.setdefault(item.target, []).append(item)
    strips = document.of_type(Strip)
    targets = {group: lineage(document, group) for group in {strip.group for strip in strips.values()}}
    return {
        name: _frames([item for target in (name, *targets[strip.group]) for item in moving.get(target, ())])
        for name, strip in strips.items()
    }


def _frames(moving: list[Keyframes]) -> tuple[float, ...]:
    if not moving:
        return ()
    moments = np.concatenate([item.times for item in moving])
    first, last = np.floor(moments.min() * FRAMES_PER_SECOND), np.ceil(moments.max() * FRAMES_PER_SECOND)
    frames = np.linspace(first, last, int(min(last - first + 1, MOST_SAMPLES))) / FRAMES_PER_SECOND
    return tuple(np.unique(np.concatenate([frames, moments])).tolist())


def _strip_prims(document: Document, times: Mapping[str, tuple[float, ...]]) -> dict[str, tuple[Prim, ...]]:
    groups = {strip.group for strip in document.of_type(Strip).values()}
    seen = {name for group in groups for name in visible_strips(document, group=group)}
    together: dict[tuple[float, ...], list[str]] = {}
    for name, moments in times.items():
        together.setdefault(moments, []).append(name)
    prims: dict[str, tuple[Prim, ...]] = {}
    for moments, names in together.items():
        strips = strip_set(document, names)
        rest = strips.nets(posed_points(strips))
        posed = {time: strips.nets(posed_points(strips, time)) for time in moments}
        for index, (name, strip) in enumerate(zip(names, strips.records, strict=True)):
            samples = {time: nets[index] for time, nets in posed.items()}
            patch = patch_prim("patch", strip, rest[index], samples=samples)
            if name not in seen:
                patch = replace(patch, attributes={**patch.attributes, **INVISIBLE})
            alone = name in seen and not strip.group
            prims[name] = (patch, _mesh_prim(document, [name], moments)) if alone else (patch,)
    return prims


def _group_prims(document: Document, times: Mapping[str, tuple[float, ...]]) -> dict[str, tuple[Prim, ...]]:
    prims: dict[str, tuple[Prim, ...]] = {}
    for group in document.of_type(Group):
        names = visible_strips(document, group=group)
        if names:
            prims[group] = (_mesh_prim(document, names, sorted({time for name in names for time in times[name]})),)
    return prims


def _mesh_prim(document: Document, names: list[str], times: Iterable[float]) -> Prim:
    prim = mesh_prim("mesh", strips_mesh(document, names=names), normals=False)
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
