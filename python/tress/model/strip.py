"""A strip of hair: one rational B-spline patch that stands for a group of strands."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from tress.base.errors import InputError
from tress.model.atlas import Atlas
from tress.model.attachment import Attachment
from tress.model.group import Group
from tress.model.knots import check_knots, degree_of
from tress.model.mesh import Mesh
from tress.model.record import Record, array
from tress.model.similarity import similarity

if TYPE_CHECKING:
    from tress.model.document import Document

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Strip(Record):
    """A NURBS patch with U control points along the hair, the root first, and V across it.

    The degrees follow from the lengths: U + degree + 1 knots along, V + degree + 1 across. Control points are plain
    (not multiplied by their weights), in metres: of an attached strip in the frame of its root (see `Attachment`), else
    in the head frame. `region` counts the regions of the `Atlas` that it is covered with. A group's `hidden` and
    `locked` hold for its strips too.
    Raises `InputError` for weights of 0 or less, knots that decrease or are too few, and degrees above 7 or above what
    the points allow.

    Source: Koh & Huang, Modeling and Animation of Human Hair in Strips, section 3.1.

    >>> knots = [0, 0, 1, 1]
    >>> flat = Strip(points=np.zeros((2, 2, 3)), weights=np.ones((2, 2)), knots_u=knots, knots_v=knots)
    >>> flat.degrees
    (1, 1)
    """

    points: Array = array("f8", "U", "V", 3, doc="Control points, metres; U along from the root, V across.")
    weights: Array = array("f8", "U", "V", doc="Above 0.")
    knots_u: Array = array("f8", "M", doc="Knots along: U + degree + 1 numbers that do not decrease.")
    knots_v: Array = array("f8", "N", doc="Knots across: V + degree + 1 numbers that do not decrease.")
    root: Attachment | None = None
    group: str = ""
    atlas: str = ""
    region: int = 0
    hidden: bool = False
    locked: bool = False

    @property
    def degrees(self) -> tuple[int, int]:
        """Degree along and across."""
        along, across = self.weights.shape
        return degree_of(self.knots_u, count=along), degree_of(self.knots_v, count=across)

    def check(self) -> None:
        """Knots fit the points, weights are positive."""
        along, across = self.weights.shape
        check_knots(self.knots_u, count=along, where="Strip.knots_u")
        check_knots(self.knots_v, count=across, where="Strip.knots_v")
        if self.weights.min() <= 0:
            raise InputError(f"Strip.weights holds {self.weights.min()}; numbers above 0 were expected.")
        if self.region < 0:
            raise InputError(f"Strip.region is {self.region}; 0 or more was expected.")

    def check_in(self, document: "Document", *, name: str) -> None:
        """Surface, group, atlas and region are there."""
        if self.root is not None:
            self.root.check_in(document, name=name)
        if self.group and not isinstance(document.records.get(self.group), Group):
            raise InputError(f"Strip {name!r} belongs to {self.group!r}, which is no group of the document.")
        if self.atlas:
            atlas = document.records.get(self.atlas)
            if not isinstance(atlas, Atlas):
                raise InputError(f"Strip {name!r} is covered with {self.atlas!r}, which is no atlas of the document.")
            if self.region >= len(atlas.regions):
                raise InputError(
                    f"Strip {name!r} is covered with region {self.region} of {self.atlas!r}; "
                    f"0 to {len(atlas.regions) - 1} was expected."
                )

    def transformed(self, new_from_old: Array) -> "Strip":
        """The strip elsewhere. An attached strip goes where its surface goes, so that it takes on the scale alone."""
        move = similarity(new_from_old)
        if self.root is None:
            return replace(self, points=move.points(self.points))
        root = replace(self.root, offset=self.root.offset * move.scale)
        return replace(self, points=self.points * move.scale, root=root)

    def evaluated(self, document: "Document", time: float, *, name: str) -> Mesh | None:
        """The mesh of a strip without a group; a group shows its strips itself."""
        from tress.model.strip_mesh import strips_mesh  # it reads strips

        return None if self.group or self.hidden else strips_mesh(document, names=(name,), time=time)
