"""A triangle mesh."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from tress.base.errors import InputError
from tress.model.record import Record, array, attributes
from tress.model.similarity import similarity
from tress.model.texture import Texture

if TYPE_CHECKING:
    from tress.model.document import Document

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Mesh(Record):
    """V vertices and F triangles, counter-clockwise seen from outside.

    `corner_uv` gives each corner of each triangle its texture coordinates (see `Texture`: v up). A mesh with a texture
    has them. Raises `InputError` for wrong shapes and for triangles that name no vertex.

    >>> Mesh(positions=[[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles=[[0, 1, 2]]).triangles.dtype.name
    'int32'
    """

    positions: Array = array("f4", "V", 3, doc="Metres.")
    triangles: Array = array("i4", "F", 3, doc="Vertices of each triangle.")
    corner_uv: Array | None = array("f4", "F", 3, 2, optional=True, doc="Texture coordinates of each corner, v up.")
    vertex_attributes: Mapping[str, Array] = attributes("V", doc="Named values per vertex.")
    texture: Texture | None = None

    def check(self) -> None:
        """Triangles name vertices; a texture needs coordinates."""
        if self.triangles.size and not 0 <= self.triangles.min() <= self.triangles.max() < len(self.positions):
            raise InputError(f"Mesh.triangles names a vertex outside 0 to {len(self.positions) - 1}.")
        if self.texture is not None and self.corner_uv is None:
            raise InputError("Mesh.texture is given without Mesh.corner_uv; texture coordinates were expected.")

    def evaluated(self, document: "Document", time: float, *, name: str) -> "Mesh":
        """The mesh itself."""
        return self

    def transformed(self, new_from_old: Array) -> "Mesh":
        """The mesh elsewhere."""
        return replace(self, positions=similarity(new_from_old).points(self.positions))
