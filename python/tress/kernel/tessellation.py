"""Triangles of NURBS patches, by knot insertion: within an accuracy, in given numbers, or within a budget.

Grid lines run through the whole patch, and every line is a knot of full multiplicity, inserted with all others at once
by the Oslo algorithm; where lines cross, the control points lie on the surface and are the corners of the mesh. Cells
share their corners, so no crack can open between spans. Where a side of a patch has collapsed to a point (the tip of a
strip), each cell has a corner of its own there, in the same place, and one triangle in place of two.

Source: `strips`, section 3.1; Cohen, Lyche, Riesenfeld 1980.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked
from tress.kernel.nurbs import Patch, Patches, answer

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Tessellation:
    """Triangles of S patches, V corners and F triangles in all.

    `positions` (V, 3) and unit `normals` (V, 3) float64; `uv` (V, 2) float64, parameters of the patch, which
    `nurbs.evaluate` takes when its control points have moved; `triangles` (F, 3) uint32, counter-clockwise about the
    normals, into all corners; those of patch i are `corner_offsets[i]` to `corner_offsets[i + 1]`, its triangles
    `triangle_offsets[i]` to `triangle_offsets[i + 1]` (S + 1,) int64; `segments` (S, 2) int64, intervals along u and v,
    whose product is the number of polygons; `error` (S,) float64, a bound of the distance between patch and mesh where
    an accuracy was asked for, NaN elsewhere.
    """

    positions: Array
    normals: Array
    uv: Array
    triangles: Array
    corner_offsets: Array
    triangle_offsets: Array
    segments: Array
    error: Array

    @property
    def corner_patch(self) -> Array:
        """(V,) int64: the patch of every corner."""
        return np.repeat(np.arange(len(self.segments)), np.diff(self.corner_offsets))

    @property
    def polygons(self) -> Array:
        """(S,) int64: polygons of every patch, quadrangles but at collapsed sides."""
        return self.segments.prod(axis=1)


def tessellate(patches: Patch | Patches, *, accuracy: float, projection: Any = None) -> Tessellation:
    """Triangles within `accuracy` of every patch, and about as few as that takes; seams at creases are kept.

    `accuracy` is a chord error in metres; with a `projection` (3, 4), which takes homogeneous points to picture x,
    picture y and divisor (`Camera.xy_from_world`), it is one in the picture, in pixels. It holds for every point of the
    surface, not only for samples: control points between two grid lines bound it. At 131,072 cells a patch stops being
    refined, and `error` tells what was reached. Cost: 1 µs a cell and pass, some four passes, on one core.

    Raises `InputError` for an accuracy that is not positive and for control points behind the camera.
    """
    if not 0 < accuracy < np.inf:
        raise InputError(f"accuracy is {accuracy}; a positive number was expected.")
    matrix = None
    if projection is not None:
        matrix = checked(projection, name="projection", dtype=np.float64, shape=(3, 4)).tolist()
    return _tessellation(answer(_core.nurbs_meshes_within, patches, float(accuracy), matrix))


def tessellate_segments(patches: Patch | Patches, *, segments: Any) -> Tessellation:
    """Triangles over equal intervals of the domains: `segments` (2,) along u and v for all, or (S, 2) for each patch.

    >>> from tress.kernel.nurbs import patch
    >>> strip = patch(np.random.default_rng(0).normal(size=(8, 4, 3)))
    >>> [int(tessellate_segments(strip, segments=s).polygons[0]) for s in ((11, 8), (7, 5), (4, 3))]
    [88, 35, 12]
    """
    counts = _counts(segments, patches, "segments")
    return _tessellation(answer(_core.nurbs_meshes_uniform, patches, counts))


def tessellate_spans(patches: Patch | Patches, *, per_span: Any) -> Tessellation:
    """Triangles with a line at every knot and `per_span` (2,) or (S, 2) equal intervals between two, along u and v."""
    counts = _counts(per_span, patches, "per_span")
    return _tessellation(answer(_core.nurbs_meshes_by_span, patches, counts))


def segments_for(patches: Patch | Patches, *, polygons: Any) -> Array:
    """(S, 2) int64: the intervals along u and v, with a product of at most `polygons`, that follow each patch best.

    `polygons` is one number for all or (S,). Fewer are used where more would bring nothing. Distances are compared at
    some 50 x 9 samples of the patch. Cost: 20 µs a polygon.
    """
    many = 1 if isinstance(patches, Patch) else len(patches)
    given = np.broadcast_to(np.asarray(polygons), (many,))
    budget = checked(given, name="polygons", dtype=np.int64, shape=(many,))
    if budget.size and budget.min() < 1:
        raise InputError(f"polygons is {budget.min()}; at least 1 a patch was expected.")
    return answer(_core.nurbs_segments_within, patches, budget)


def _tessellation(arrays: Any) -> Tessellation:
    positions, normals, uv, triangles, (corners, starts), segments, error = arrays
    return Tessellation(positions, normals, uv, triangles, corners, starts, segments, error)


def _counts(value: Any, patches: Patch | Patches, name: str) -> Array:
    many = 1 if isinstance(patches, Patch) else len(patches)
    given = np.asarray(value)
    if given.shape == (2,):
        given = np.broadcast_to(given, (many, 2))
    counts = checked(given, name=name, dtype=np.int64, shape=(many, 2))
    if counts.size and not (counts.min() >= 1 and counts.prod(axis=1).max() <= 1 << 20):
        raise InputError(f"{name} runs from {counts.min()} to {counts.max()}; 1 to a product of 2**20 was expected.")
    return counts
