"""A document with the built-in head and no hair: what presets begin with."""

import numpy as np

from tress.head.statistical import REGIONS, load_statistical_head
from tress.model.document import Document
from tress.model.head import MASKS, Head
from tress.model.mesh import Mesh

HEAD = "head"


def bald_document() -> Document:
    """The mean of the statistical head as `head`, in the head frame. Raises `AssetMissingError` where it is not built.

    >>> sorted(bald_document().records)
    ['head']
    """
    model = load_statistical_head()
    mesh = Mesh(
        positions=model.mean,
        triangles=model.triangles,
        corner_uv=model.corner_uv,
        vertex_attributes={name: model.masks[name] for name in MASKS if name in REGIONS},
    )
    head = Head(
        mesh=mesh,
        shape=np.zeros(len(model.shape_components), np.float32),
        expression=np.zeros(len(model.expression_components), np.float32),
    )
    return Document({HEAD: head})
