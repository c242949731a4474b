"""A small document of the kind that `tress portrait` writes."""

import numpy as np

from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.strands import Strands
from tress.model.texture import Texture


def portrait():
    """A document with everything that a format may promise to keep."""
    random = np.random.default_rng(5)
    lengths = random.integers(2, 30, 60)
    total = int(lengths.sum())
    hair = Strands(
        points=random.normal(size=(total, 3)) * 0.1,
        offsets=np.concatenate([[0], np.cumsum(lengths)]),
        point_attributes={
            "color": random.random((total, 3)),
            "alpha": random.random(total),
            "radius": random.random(total) * 1e-4,
        },
        strand_attributes={"visible": random.random(60) > 0.5},
    )
    mesh = Mesh(
        positions=random.random((5, 3)),
        triangles=[[0, 1, 2], [2, 3, 4]],
        corner_uv=random.random((2, 3, 2)),
        texture=Texture(pixels=random.integers(0, 255, (4, 6, 3)).astype(np.uint8)),
    )
    camera = Camera(xy_from_world=[[3000, 1, 2, 500], [3, -3000, 4, 400], [0, 0, 0, 1]], width=1000, height=800)
    return Document(
        {
            "hair": hair,
            "head": Head(mesh=mesh, shape=[0.5], expression=[]),
            "photo": camera,
            "recipe": Recipe(method="portrait", seed=3, parameters={"strands": 60}),
        }
    )
