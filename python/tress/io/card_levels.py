"""From a document and its levels of detail to what a GLB file holds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tress.io.card_mesh import CardMesh, card_mesh
from tress.io.strip_glb import CardLevel
from tress.io.usd.shown import sample_times
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.model.group import Group, lineage
from tress.model.keyframes import Keyframes
from tress.model.level import Level, level_surface
from tress.model.principal_motion import PrincipalMotion, principal_motion
from tress.model.strip import Strip
from tress.model.strip_set import StripSet, strip_set
from tress.model.strips import visible_strips

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class CardLevels:
    """Levels ready to be written, and their motion: None where nothing moves; with `step` it jumps."""

    levels: tuple[CardLevel, ...]
    motion: PrincipalMotion | None
    step: bool


def card_levels(
    document: Document,
    levels: Sequence[Level],
    *,
    atlases: Sequence[Mapping[str, Atlas]] | None = None,
    coverage: Sequence[float] = (),
    accuracy: float = 1e-4,
) -> CardLevels:
    """The levels with a mesh for every atlas, and one motion for all of them, within `accuracy` (metres).

    `atlases` are those of each level, by default the document's own; `coverage` the share of the picture's height at
    which a level gives way to the next.
    """
    strips = strip_set(document, sorted({name for level in levels for name in level.names}))
    times, step = clip_times(document, strips.names)
    motion = principal_motion(strips, times=times, accuracy=accuracy) if times else None
    own = document.of_type(Atlas)
    made = []
    for number, level in enumerate(levels):
        cards = _cards(document, level, strips, motion)
        share = coverage[number] if number < len(coverage) else 0.0
        made.append(CardLevel(cards, own if atlases is None else atlases[number], share))
    return CardLevels(tuple(made), motion, step)


def plain_level(document: Document) -> Level | None:
    """All visible strips, every span in as many polygons as its degree; None where there are no strips."""
    groups = ["", *document.of_type(Group)]
    names = tuple(sorted(name for group in groups for name in visible_strips(document, group=group)))
    if not names:
        return None
    segments = np.array([_segments(document.records[name]) for name in names], np.int64)
    return Level(names=names, segments=segments, widening=np.ones(len(names)))


def clip_times(document: Document, names: Sequence[str]) -> tuple[list[float], bool]:
    """When the strips are sampled for a clip (seconds), and whether it jumps: the moments themselves where every motion
    is linear or every one jumps, else every frame too."""
    strips = [strip for name in names if isinstance(strip := document.records[name], Strip)]
    targets = {*names, *(group for strip in strips for group in lineage(document, strip.group))}
    moving = [item for item in document.of_type(Keyframes).values() if item.target in targets]
    kinds = {item.interpolation for item in moving}
    if not moving:
        return [], False
    if len(kinds) == 1 and kinds <= {"linear", "step"}:
        return np.unique(np.concatenate([item.times for item in moving])).tolist(), kinds == {"step"}
    found = {
        time
        for name, strip in zip(names, strips, strict=True)
        for time in sample_times(document, group=strip.group, strip=name)
    }
    return sorted(found), False


def _segments(strip: Any) -> tuple[int, int]:
    (along, across), (degree_u, degree_v) = strip.weights.shape, strip.degrees
    spans_u = len(np.unique(strip.knots_u[degree_u : along + 1])) - 1
    spans_v = len(np.unique(strip.knots_v[degree_v : across + 1])) - 1
    return spans_u * degree_u, spans_v * degree_v


def _cards(document: Document, level: Level, strips: StripSet, motion: PrincipalMotion | None) -> tuple[CardMesh, ...]:
    """A mesh for every atlas of the level, in alphabetical order."""
    place = {name: index for index, name in enumerate(strips.names)}
    atlas_of = np.array([strips.records[place[name]].atlas for name in level.names])
    cards = []
    for atlas in np.unique(atlas_of):
        mine = np.flatnonzero(atlas_of == atlas)
        part = level.part(mine)
        rows = np.concatenate([np.arange(*strips.offsets[place[name] :][:2]) for name in part.names])
        moved = None if motion is None else replace(motion, shapes=motion.shapes[:, rows])
        cards.append(card_mesh(document, level_surface(document, part), atlas=str(atlas), motion=moved))
    return tuple(cards)
