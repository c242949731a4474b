"""A head in its own colours: skin, and under the hair the colour of the hair."""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.methods.strips.bald_document import HEAD
from tress.model.document import Document
from tress.model.head import Head
from tress.model.mesh import Mesh

Array = np.ndarray[Any, Any]
Color = tuple[float, float, float]

SKIN: Color = (0.50, 0.29, 0.20)
"""Linear colour of a head without a picture."""
SHADED = 0.9
"""How far the scalp has the colour of the hair: roots that no strip stands for."""
ROOTS = 0.6
"""How bright they are beside the hair above them."""


def painted(document: Document, *, color: Color) -> Document:
    """The document whose `head` has the vertex attribute `color`: what pictures show and every format writes.

    A head with a picture keeps that and gets none. `color` is that of the hair, linear.
    """
    head = document.records.get(HEAD)
    if not isinstance(head, Head) or head.mesh.texture is not None:
        return document
    attributes = {**head.mesh.vertex_attributes, "color": skin_colors(head.mesh, color=color)}
    mesh = replace(head.mesh, vertex_attributes=attributes)
    return Document({**document.records, HEAD: replace(head, mesh=mesh)})


def head_colors(mesh: Mesh, *, color: Color) -> Array:
    """(V, 3) float32: the colours that a head was painted with, or those that it would be painted with."""
    found = mesh.vertex_attributes.get("color")
    own = found is not None and found.shape == (len(mesh.positions), 3)
    return found.astype(np.float32) if own and found is not None else skin_colors(mesh, color=color)


def skin_colors(mesh: Mesh, *, color: Color) -> Array:
    """(V, 3) float32 linear: skin, and on the scalp mostly the colour of the hair in the shade of the hair."""
    scalp = mesh.vertex_attributes.get("scalp", np.zeros(len(mesh.positions), np.float32))[:, None]
    return (np.asarray(SKIN) + SHADED * scalp * (ROOTS * np.asarray(color) - SKIN)).astype(np.float32)
