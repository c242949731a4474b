"""A head fitted to a photograph."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from tress.base.errors import InputError
from tress.model.mesh import Mesh
from tress.model.record import Record, array

if TYPE_CHECKING:
    from tress.model.document import Document

MASKS = ("scalp", "face", "ears", "lips", "eyes", "neck")


@dataclass(frozen=True, eq=False)
class Head(Record):
    """The head's surface and what made it, in the head frame: upright, facing +Z, Y up, origin the head's centre.

    The vertex attributes of `mesh` hold masks in [0, 1], float32, under the names of `MASKS`, as far as they are known.
    """

    mesh: Mesh
    shape: np.ndarray[Any, Any] = array("f4", "K", doc="Coefficients of the statistical shape.")
    expression: np.ndarray[Any, Any] = array("f4", "E", doc="Coefficients of the expression.")
    landmarks_px: np.ndarray[Any, Any] | None = array(
        "f4", "L", 3, optional=True, doc="Landmarks in the photograph: x, y, and z towards the viewer, pixels."
    )

    def check(self) -> None:
        """Masks are one number per vertex."""
        for name in MASKS:
            mask = self.mesh.vertex_attributes.get(name)
            if mask is not None and (mask.dtype != np.float32 or mask.ndim != 1):
                raise InputError(f'Head mask "{name}" is {mask.dtype} {mask.shape}; float32 (V,) was expected.')

    def evaluated(self, document: "Document", time: float, *, name: str) -> Mesh:
        """The head's mesh."""
        return self.mesh

    def transformed(self, new_from_old: np.ndarray[Any, Any]) -> "Head":
        """The head elsewhere."""
        return replace(self, mesh=self.mesh.transformed(new_from_old))
