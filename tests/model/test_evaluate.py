"""Evaluation gives what can be seen: strands and meshes, a head's too, under the identifiers of their records."""

from dataclasses import dataclass, field

import numpy as np

from tress.base.params import Params, param
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.evaluate import evaluate
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe, flat_parameters
from tress.model.strands import Strands


def test_a_portrait_shows_head_and_hair():
    mesh = Mesh(positions=np.eye(3), triangles=[[0, 1, 2]])
    hair = Strands(points=np.eye(3), offsets=[0, 3])
    document = Document(
        {
            "head": Head(mesh=mesh, shape=[], expression=[]),
            "hair": hair,
            "photo": Camera(xy_from_world=np.eye(4)[[0, 1, 3]], width=1, height=1),
            "recipe": Recipe(method="portrait"),
        }
    )
    scene = evaluate(document, time=0.0)
    assert (dict(scene.strands), dict(scene.meshes)) == ({"hair": hair}, {"head": mesh})


@dataclass(frozen=True)
class Inner(Params):
    step_px: float = param(0.75, low=0, high=1, doc="Step.")


@dataclass(frozen=True)
class Outer(Params):
    count: int = param(5, low=0, high=9, doc="Count.")
    trace: Inner = field(default_factory=Inner)
    path: str | None = None


def test_parameters_within_parameters_get_dotted_names():
    assert flat_parameters(Outer()) == {"count": 5, "trace.step_px": 0.75}
