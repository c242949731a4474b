"""Where a strip is rooted."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from tress.base.errors import InputError
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.record import Record, array

if TYPE_CHECKING:
    from tress.model.document import Document

TOLERANCE = 1e-6


@dataclass(frozen=True, eq=False)
class Attachment(Record):
    """A root on a triangle of a `Head` or a `Mesh`, which the strip follows when that surface changes.

    The root's frame: z is the outward normal of the triangle, x runs from its first to its second vertex, y is z × x;
    the origin is the barycentric point, moved by `offset` along these axes. Axes are unit vectors, so a larger head
    moves strips and does not stretch them. Raises `InputError` where the barycentric coordinates do not add up to 1.
    """

    surface: str
    triangle: int
    barycentric: np.ndarray[Any, Any] = array("f8", 3, doc="Place on the triangle; adds up to 1.")
    offset: np.ndarray[Any, Any] = array("f8", 3, doc="Metres along the axes of the frame.")

    def check(self) -> None:
        """A triangle, and a place on its plane."""
        if self.triangle < 0:
            raise InputError(f"Attachment.triangle is {self.triangle}; 0 or more was expected.")
        if abs(self.barycentric.sum() - 1) > TOLERANCE:
            raise InputError(f"Attachment.barycentric adds up to {self.barycentric.sum()}; 1 was expected.")

    def check_in(self, document: "Document", *, name: str) -> None:
        """The surface is there and has the triangle."""
        mesh = surface_mesh(document, self.surface, where=f"Record {name!r}")
        if self.triangle >= len(mesh.triangles):
            raise InputError(
                f"Record {name!r} is attached to triangle {self.triangle} of {self.surface!r}; "
                f"0 to {len(mesh.triangles) - 1} was expected."
            )


def surface_mesh(document: "Document", surface: str, *, where: str) -> Mesh:
    """The `Mesh` of a record that strips can be attached to. Raises `InputError` where it is absent or has none."""
    record = document.records.get(surface)
    mesh = record.mesh if isinstance(record, Head) else record
    if not isinstance(mesh, Mesh):
        found = "is absent" if record is None else f"is a {type(record).__name__}"
        raise InputError(f"{where} is attached to {surface!r}, which {found}; a head or a mesh was expected.")
    return mesh
