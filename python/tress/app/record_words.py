"""A record in a line, for people: one function for each type that has more to say than its arrays."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from tress.model.atlas import Atlas
from tress.model.camera import Camera
from tress.model.group import Group
from tress.model.head import Head
from tress.model.keyframes import Keyframes
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.record import Record
from tress.model.strands import Strands
from tress.model.strip import Strip


def record_words(record: Record) -> str:
    """What the record holds, in one line."""
    words = WORDS.get(type(record))
    return words(record) if words else ", ".join(_field_words(record))


def many_words(records: Sequence[Record]) -> str:
    """What many records of one type hold together, in one line."""
    words = f"{len(records):,} of them; -v shows each"
    strips = [record for record in records if isinstance(record, Strip)]
    if not strips:
        return words
    points = sum(strip.weights.size for strip in strips)
    groups, attached = {strip.group for strip in strips}, sum(strip.root is not None for strip in strips)
    return f"{words}; {points:,} control points, {len(groups)} groups, {attached:,} attached"


def _group(group: Group) -> str:
    parts = [
        f"in {group.parent}" if group.parent else "",
        "hidden" if group.hidden else "",
        "locked" if group.locked else "",
    ]
    return ", ".join(part for part in parts if part) or "a group"


def _atlas(atlas: Atlas) -> str:
    height, width = atlas.color.shape[:2]
    maps = f"; {', '.join(atlas.maps)}" if atlas.maps else ""
    return f"{width} x {height} px, {len(atlas.regions)} regions{maps}"


def _keyframes(keyframes: Keyframes) -> str:
    kind, span = keyframes.interpolation, f"{keyframes.times[0]:g} to {keyframes.times[-1]:g} s"
    return (
        f"{len(keyframes.times)} moments from {span} for {keyframes.target}, {kind}{', loop' if keyframes.loop else ''}"
    )


def _strands(strands: Strands) -> str:
    if not strands.count:
        return "no strands"
    steps = np.linalg.norm(np.diff(strands.points, axis=0), axis=1)
    steps[strands.offsets[1:-1] - 1] = 0  # from one strand to the next
    mean_cm = 100 * steps.sum(dtype=np.float64) / strands.count
    counts = f"{strands.lengths.min()} to {strands.lengths.max()} points each"
    named = ", ".join([*strands.point_attributes, *strands.strand_attributes]) or "no attributes"
    return f"{strands.count:,} strands, {counts}, {mean_cm:.3g} cm long in the mean; {named}"


def _mesh(mesh: Mesh) -> str:
    words = f"{len(mesh.positions):,} vertices, {len(mesh.triangles):,} triangles"
    if mesh.texture is not None:
        height, width = mesh.texture.pixels.shape[:2]
        words += f", picture of {width} x {height} px"
    return words


def _head(head: Head) -> str:
    return _mesh(head.mesh)


def _camera(camera: Camera) -> str:
    return f"{camera.width} x {camera.height} px"


def _recipe(recipe: Recipe) -> str:
    return f"{recipe.method}, seed {recipe.seed}, {len(recipe.parameters)} parameters"


WORDS: Mapping[type[Record], Callable[[Any], str]] = {
    Atlas: _atlas,
    Group: _group,
    Keyframes: _keyframes,
    Strands: _strands,
    Mesh: _mesh,
    Head: _head,
    Camera: _camera,
    Recipe: _recipe,
}


def _field_words(record: Record) -> Iterator[str]:
    """The fields of any record: shapes of arrays, what is plain, names of the rest."""
    for field in dataclasses.fields(record):
        value = getattr(record, field.name)
        if isinstance(value, np.ndarray):
            yield f"{field.name} {' x '.join(map(str, value.shape))}"
        elif isinstance(value, str | int | float) and not isinstance(value, bool) and value != "":
            yield f"{field.name} {value}"
        elif value not in (None, "", False) and not isinstance(value, Mapping):
            yield field.name
