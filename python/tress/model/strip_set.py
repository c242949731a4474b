"""Many strips as flat arrays, and where their control points are at a time.

Built once (about 10 µs a strip), asked often: at 60 frames a second a hairdo is posed and tessellated from here with a
few operations on arrays, not with a few for each strip.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tress.kernel import nurbs
from tress.model.document import Document
from tress.model.group import lineage
from tress.model.keyframes import Keyframes
from tress.model.root_frames import RootFrames, root_frames
from tress.model.strip import Strip
from tress.model.tracks import FlatTracks, Track, blended, flat_tracks

Array = np.ndarray[Any, Any]

STAGES = ("position", "root", "head")


@dataclass(frozen=True, eq=False)
class Layer:
    """One motion for some control points: `target` (M,) rows of the strip set, each once, get control point `point`
    (M,) of track `track` (M,)."""

    target: Array
    point: Array
    track: Array


@dataclass(frozen=True, eq=False)
class Motion:
    """What moves: positions that replace, displacements along the axes of the roots, and along those of the head."""

    tracks: FlatTracks
    positions: tuple[Layer, ...]
    in_root: tuple[Layer, ...]
    in_head: tuple[Layer, ...]


@dataclass(frozen=True, eq=False)
class StripSet:
    """S strips with N control points together: strip i has the rows `offsets[i]` to `offsets[i + 1]`, row by row.

    `points` (N, 3) float64 as they rest in the strips' own frames, `strip` (N,) the strip of each, `shapes` (S, 2).
    """

    names: tuple[str, ...]
    records: tuple[Strip, ...]
    points: Array
    offsets: Array
    strip: Array
    shapes: Array
    frames: RootFrames
    motion: Motion | None

    def nets(self, values: Array) -> list[Array]:
        """The (U, V, ...) part of each strip in `values` (N, ...)."""
        parts = np.split(values, self.offsets[1:-1])
        return [part.reshape(*shape, *values.shape[1:]) for part, shape in zip(parts, self.shapes, strict=True)]


def strip_set(document: Document, names: Sequence[str]) -> StripSet:
    """The strips `names` of a document, with the roots that they are attached to and the keyframes that move them."""
    records = tuple(document.records[name] for name in names)
    strips = tuple(record for record in records if isinstance(record, Strip))
    shapes = np.array([strip.weights.shape for strip in strips], np.int64).reshape(-1, 2)
    sizes = shapes.prod(axis=1)
    offsets = np.concatenate([np.zeros(1, np.int64), np.cumsum(sizes)])
    return StripSet(
        names=tuple(names),
        records=strips,
        points=np.concatenate([np.zeros((0, 3)), *(strip.points.reshape(-1, 3) for strip in strips)]),
        offsets=offsets,
        strip=np.repeat(np.arange(len(strips)), sizes),
        shapes=shapes,
        frames=root_frames(document, [strip.root for strip in strips]),
        motion=_motion(document, names, strips, offsets),
    )


def kernel_patches(strips: Sequence[Strip], points: Array | None = None) -> nurbs.Patches:
    """The strips as the kernel takes them, with these control points (N, 3), or their own."""
    found = nurbs.Patches.of(
        [nurbs.Patch(strip.points, strip.weights, strip.knots_u, strip.knots_v, *strip.degrees) for strip in strips]
    )
    return found if points is None else replace(found, points=points)


def posed_points(strips: StripSet, time: float = 0.0) -> Array:
    """(N, 3) float64 control points at `time` (seconds), in the head frame, metres."""
    return strips.frames.points_in_head(_moved(strips, time), strip=strips.strip) + _displaced_in_head(strips, time)


def resting_points(strips: StripSet) -> Array:
    """(N, 3) float64 control points without keyframes, in the head frame, metres."""
    return strips.frames.points_in_head(strips.points, strip=strips.strip)


def _moved(strips: StripSet, time: float) -> Array:
    """Control points in their own frames: positions first, then displacements."""
    motion = strips.motion
    if motion is None:
        return strips.points
    points = strips.points.copy()
    for layer in motion.positions:
        points[layer.target] = blended(motion.tracks, layer.point, layer.track, time)
    for layer in motion.in_root:
        points[layer.target] += blended(motion.tracks, layer.point, layer.track, time)
    return points


def _displaced_in_head(strips: StripSet, time: float) -> Array | float:
    motion = strips.motion
    if motion is None or not motion.in_head:
        return 0.0
    total = np.zeros((len(strips.points), 3))
    for layer in motion.in_head:
        total[layer.target] += blended(motion.tracks, layer.point, layer.track, time)
    return total


def _motion(document: Document, names: Sequence[str], strips: Sequence[Strip], offsets: Array) -> Motion | None:
    """The keyframes that move any of the strips, directly or through a group, in layers that touch a point once."""
    by_target: dict[str, list[Keyframes]] = {}
    for keyframes in document.of_type(Keyframes).values():
        by_target.setdefault(keyframes.target, []).append(keyframes)

    listed: dict[tuple[int, tuple[int, int]], Track] = {}
    places: dict[tuple[int, tuple[int, int]], int] = {}
    layers: dict[tuple[str, int], list[tuple[int, int]]] = {}
    for index, (name, strip) in enumerate(zip(names, strips, strict=True)):
        depth: dict[str, int] = dict.fromkeys(STAGES, 0)
        for target in (name, *lineage(document, strip.group)):
            for keyframes in by_target.get(target, ()):
                key = (id(keyframes), strip.weights.shape)
                listed.setdefault(key, Track(keyframes, strip.weights.shape))
                place = places.setdefault(key, len(places))
                stage = "position" if keyframes.kind == "position" else keyframes.frame
                layers.setdefault((stage, depth[stage]), []).append((index, place))
                depth[stage] += 1
    if not listed:
        return None
    made = {key: _layer(pairs, offsets) for key, pairs in sorted(layers.items())}
    stages = [tuple(layer for (name, _), layer in made.items() if name == stage) for stage in STAGES]
    return Motion(flat_tracks(list(listed.values())), *stages)


def _layer(pairs: list[tuple[int, int]], offsets: Array) -> Layer:
    strip, track = np.array(pairs, np.int64).T
    sizes = offsets[strip + 1] - offsets[strip]
    point = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return Layer(target=np.repeat(offsets[strip], sizes) + point, point=point, track=np.repeat(track, sizes))
