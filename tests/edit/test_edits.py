"""Edits say what changes and leave the document alone; their reverse brings everything back."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tress.base.errors import InputError
from tress.edit.delete import delete
from tress.edit.recolour import recolour
from tress.edit.transform import transform
from tress.model.camera import Camera
from tress.model.diff import apply, reverse
from tress.model.document import Document
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.strands import Strands

RANDOM = np.random.default_rng(2)
HAIR = Strands(
    points=RANDOM.random((7, 3)),
    offsets=[0, 3, 7],
    point_attributes={"color": RANDOM.random((7, 3)), "radius": np.full(7, 1e-4)},
)
MESH = Mesh(positions=RANDOM.random((4, 3)), triangles=[[0, 1, 2], [1, 2, 3]])
DOCUMENT = Document(
    {
        "bald": Strands(points=HAIR.points, offsets=HAIR.offsets),
        "hair": HAIR,
        "head": Head(mesh=MESH, shape=[], expression=[]),
        "photo": Camera(xy_from_world=[[300, 0, 0, 50], [0, -300, 0, 50], [0, 0, 0, 1]], width=100, height=100),
        "recipe": Recipe(method="portrait"),
    }
)
MOVE = np.eye(4)
MOVE[:3, :3] = 2.0 * Rotation.from_euler("xyz", [0.3, -1.0, 2.0]).as_matrix()
MOVE[:3, 3] = 0.1, -0.2, 0.3


@pytest.mark.parametrize(
    "diff",
    [
        delete(DOCUMENT, names=["hair", "head"]),
        recolour(DOCUMENT, name="hair", color=(0.4, 0.1, 0.05)),
        transform(DOCUMENT, names=["hair", "head", "photo"], new_from_old=MOVE),
    ],
    ids=["delete", "recolour", "transform"],
)
def test_an_edit_changes_something_and_can_be_taken_back(diff):
    after = apply(diff, DOCUMENT)
    assert after != DOCUMENT
    assert apply(reverse(diff), after) == DOCUMENT


def test_recoloured_hair_has_the_colour_on_average_and_its_hue_everywhere():
    color = np.array([0.4, 0.1, 0.05])
    found = (
        apply(recolour(DOCUMENT, name="hair", color=tuple(color)), DOCUMENT).records["hair"].point_attributes["color"]
    )
    assert found.mean(axis=0) == pytest.approx(color, rel=1e-5)
    assert np.allclose(found / found[:, :1], color / color[0], rtol=1e-5)
    assert np.ptp(found[:, 0]) > 0.1
    plain = apply(recolour(DOCUMENT, name="hair", color=tuple(color), variation=0), DOCUMENT)
    assert np.allclose(plain.records["hair"].point_attributes["color"], color)
    bald = apply(recolour(DOCUMENT, name="bald", color=tuple(color)), DOCUMENT)
    assert np.allclose(bald.records["bald"].point_attributes["color"], color)


def test_recolouring_by_the_own_mean_keeps_the_luminance():
    color = tuple(HAIR.point_attributes["color"].mean(axis=0).tolist())
    found = apply(recolour(DOCUMENT, name="hair", color=color), DOCUMENT).records["hair"].point_attributes["color"]
    weights = [0.2126, 0.7152, 0.0722]
    assert np.allclose(found @ weights, HAIR.point_attributes["color"] @ weights, rtol=1e-5)


def test_a_transform_moves_all_alike_and_the_camera_sees_the_same():
    after = apply(transform(DOCUMENT, names=["hair", "head", "photo"], new_from_old=MOVE), DOCUMENT).records
    assert np.allclose(after["hair"].points, HAIR.points @ MOVE[:3, :3].T + MOVE[:3, 3], atol=1e-6)
    assert np.allclose(after["head"].mesh.positions, MESH.positions @ MOVE[:3, :3].T + MOVE[:3, 3], atol=1e-6)
    assert np.allclose(after["hair"].point_attributes["radius"], 2e-4)
    seen = DOCUMENT.records["photo"].project(HAIR.points)
    assert np.allclose(after["photo"].project(after["hair"].points), seen, atol=1e-3)


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda: delete(DOCUMENT, names=["wig"]), "no record 'wig' to delete"),
        (lambda: recolour(DOCUMENT, name="wig", color=(1, 1, 1)), "'wig' is absent; strands"),
        (lambda: recolour(DOCUMENT, name="head", color=(1, 1, 1)), "'head' is a Head; strands"),
        (lambda: recolour(DOCUMENT, name="hair", color=(1, -1, 1)), "0 or more"),
        (lambda: transform(DOCUMENT, names=["wig"], new_from_old=MOVE), "no record 'wig'"),
        (lambda: transform(DOCUMENT, names=["recipe"], new_from_old=MOVE), "Recipe has no place"),
        (lambda: transform(DOCUMENT, names=["hair"], new_from_old=np.diag([1, 1, -1, 1])), "mirrors"),
        (lambda: transform(DOCUMENT, names=["hair"], new_from_old=np.diag([1, 1, 2, 1])), "shears"),
        (lambda: transform(DOCUMENT, names=["hair"], new_from_old=np.eye(3)), "matrix"),
    ],
)
def test_wrong_edits_are_refused(edit, message):
    with pytest.raises(InputError, match=message):
        edit()
