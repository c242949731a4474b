"""Hair as strands: polylines from root to tip, flat arrays."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from tress.base.errors import InputError
from tress.model.record import Record, array, attributes
from tress.model.similarity import similarity

if TYPE_CHECKING:
    from tress.model.document import Document

Array = np.ndarray[Any, Any]

STANDARD_POINT_ATTRIBUTES = {"color": ("f4", (3,)), "alpha": ("f4", ()), "radius": ("f4", ())}
STANDARD_STRAND_ATTRIBUTES = {"root_triangle": ("i4", ()), "root_barycentric": ("f4", (3,)), "visible": ("?", ())}
MAX_RADIUS_M = 1e6  # files of others have units of their own


@dataclass(frozen=True, eq=False)
class Strands(Record):
    """S strands with N points together: strand i is `points[offsets[i]:offsets[i + 1]]`, at least two points each.

    Standard point attributes: `color` (N, 3) float32 linear RGB, `alpha` (N,) float32 in [0, 1], `radius` (N,) float32
    metres. Standard strand attributes: `root_triangle` (S,) int32 (-1: not rooted), `root_barycentric` (S, 3) float32,
    `visible` (S,) bool (traced in the photograph). Others may be added: float32, float64, int32, int64, uint8
    or bool; a name is used once. Raises `InputError` for wrong shapes, offsets out of order, negative
    radii and numbers that are not finite.

    >>> strands = Strands(points=[[0, 0, 0], [0, 1, 0], [0, 2, 0]], offsets=[0, 3])
    >>> strands.count, strands.points.dtype.name
    (1, 'float32')
    """

    points: Array = array("f4", "N", 3, doc="Metres, root to tip, strand after strand.")
    offsets: Array = array("i8", "S+1", doc="First point of each strand, and the number of points at the end.")
    point_attributes: Mapping[str, Array] = attributes(
        "N", standard=STANDARD_POINT_ATTRIBUTES, doc="Named values per point."
    )
    strand_attributes: Mapping[str, Array] = attributes(
        "S", standard=STANDARD_STRAND_ATTRIBUTES, doc="Named values per strand."
    )

    @property
    def count(self) -> int:
        """Number of strands."""
        return len(self.offsets) - 1

    @property
    def lengths(self) -> Array:
        """(S,) int64: number of points of each strand."""
        return np.diff(self.offsets)

    def check(self) -> None:
        """Offsets start at 0, rise by at least 2 and end at the number of points; names are given once."""
        if len(self.offsets) == 0 or self.offsets[0] != 0 or self.offsets[-1] != len(self.points):
            raise InputError(f"Strands.offsets must run from 0 to the number of points, {len(self.points)}.")
        if twice := set(self.point_attributes) & set(self.strand_attributes):
            raise InputError(f"Attribute {min(twice)!r} is given per point and per strand; one of them was expected.")
        if len(self.offsets) > 1 and self.lengths.min() < 2:
            strand = int(np.argmin(self.lengths))
            raise InputError(f"Strand {strand} has {self.lengths[strand]} points; at least 2 were expected.")

        radius = self.point_attributes.get("radius")
        if radius is not None and radius.size and not 0 <= radius.min() <= radius.max() <= MAX_RADIUS_M:
            raise InputError(f"Radii run from {radius.min()} to {radius.max()} m; 0 to {MAX_RADIUS_M} were expected.")

    def evaluated(self, document: "Document", time: float, *, name: str) -> "Strands":
        """The strands themselves."""
        return self

    def transformed(self, new_from_old: Array) -> "Strands":
        """The strands elsewhere; the radius grows with the scale."""
        move = similarity(new_from_old)
        point_attributes = dict(self.point_attributes)
        if "radius" in point_attributes:
            point_attributes["radius"] = point_attributes["radius"] * np.float32(move.scale)
        return replace(self, points=move.points(self.points), point_attributes=point_attributes)
