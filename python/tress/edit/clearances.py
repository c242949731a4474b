"""How far strips are from a surface."""

from collections.abc import Iterable

import numpy as np

from tress.edit.surface_distance import DENSITY, distances, skin
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.strip_grid import strip_grid
from tress.model.strip_set import posed_points, strip_set
from tress.model.strips import strip_names


def clearances(
    document: Document, *, names: Iterable[str], surface: str, time: float = 0.0, density: int = DENSITY
) -> dict[str, float]:
    """The least signed distance (metres, negative inside) of each strip from a closed surface at `time`, by name.

    Raises `InputError` where the surface is no `Head` or `Mesh`, or a name is no strip or group.
    """
    mesh = skin(surface_mesh(document, surface, where="A strip"))
    strips = strip_set(document, strip_names(document, names))
    grid = strip_grid(strips.records, density=density)
    least = np.full(len(strips.names), np.inf)
    if len(grid.strip):
        np.minimum.at(least, grid.strip, distances(mesh, grid.points(posed_points(strips, time)))[0])
    return dict(zip(strips.names, least.tolist(), strict=True))
