"""Records freeze their arrays, and refuse what does not fit in one sentence."""

import pickle

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.model.camera import Camera
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.records import RECORDS
from tress.model.strands import Strands
from tress.model.texture import Texture

POINTS = np.arange(15, dtype=np.float64).reshape(5, 3)
TRIANGLE = {"positions": np.eye(3), "triangles": [[0, 1, 2]]}
AFFINE = [[100, 0, 0, 50], [0, -100, 0, 50], [0, 0, 0, 1]]


def two_strands(**changes):
    return Strands(**{"points": POINTS, "offsets": [0, 2, 5]} | changes)


def test_arrays_have_the_declared_dtype_and_cannot_be_written():
    strands = two_strands(point_attributes={"alpha": np.ones(5)}, strand_attributes={"id": np.arange(2)})
    assert (strands.points.dtype, strands.offsets.dtype) == (np.float32, np.int64)
    assert strands.point_attributes["alpha"].dtype == np.float32
    for values in (strands.points, strands.offsets, strands.strand_attributes["id"]):
        assert values.flags.c_contiguous
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 0


def test_the_callers_array_is_neither_frozen_nor_shared():
    points = POINTS.astype(np.float32)
    strands = two_strands(points=points)
    points[0] = 99
    assert strands.points[0, 0] == 0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"points": POINTS[:, :2]}, r"Strands.points has shape \(5, 2\); \(N, 3\) was expected"),
        ({"points": [[0, 0, np.nan]] * 5}, "Strands.points holds numbers that are not finite"),
        ({"points": np.full((5, 3), 1e300)}, "not finite"),
        ({"points": [["a"] * 3] * 5}, "dtype"),
        ({"points": [[0, 0, 0], [1]]}, "not a rectangular array"),
        ({"offsets": [0.0, 2.0, 5.0]}, "dtype float64; int64"),
        ({"offsets": []}, "offsets must run from 0"),
        ({"offsets": [1, 3, 5]}, "offsets must run from 0"),
        ({"offsets": [0, 2, 6]}, "offsets must run from 0 to the number of points, 5"),
        ({"offsets": [0, 4, 2, 5]}, "Strand 1 has -2 points"),
        ({"offsets": [0, 4, 5]}, "Strand 1 has 1 points"),
        ({"point_attributes": {"alpha": np.ones(4)}}, r'"alpha"\] has shape \(4,\); \(5\) was expected'),
        ({"point_attributes": {"radius": -np.ones(5)}}, "Radii run from -1.0 to -1.0 m"),
        ({"point_attributes": {"color": np.ones(5)}}, r"\(5, 3\) was expected"),
        ({"point_attributes": {"wind": np.ones(4)}}, "5 rows"),
        ({"point_attributes": {"wind": np.ones(5, "f2")}}, "dtype float16; one of float32"),
        ({"point_attributes": {"two words": np.ones(5)}}, "letters, digits"),
        ({"strand_attributes": {"visible": [1, 0]}}, "bool was expected"),
        (
            {"point_attributes": {"id": np.arange(5)}, "strand_attributes": {"id": np.arange(2)}},
            "'id' is given per point and per strand",
        ),
    ],
)
def test_strands_refuse(changes, message):
    with pytest.raises(InputError, match=message):
        two_strands(**changes)


def test_no_strands_at_all_is_a_state():
    assert Strands(points=np.zeros((0, 3)), offsets=[0]).count == 0


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Mesh(**TRIANGLE | {"triangles": [[0, 1, 3]]}), "outside 0 to 2"),
        (lambda: Mesh(**TRIANGLE | {"triangles": [[0, 1, -1]]}), "outside 0 to 2"),
        (lambda: Mesh(**TRIANGLE, corner_uv=np.zeros((2, 3, 2))), r"\(1, 3, 2\) was expected"),
        (lambda: Mesh(**TRIANGLE, texture=Texture(pixels=np.zeros((1, 1, 3), np.uint8))), "without Mesh.corner_uv"),
        (lambda: Mesh(**TRIANGLE, texture="photo.png"), "Texture"),
        (lambda: Texture(pixels=np.zeros((4, 4, 2), np.uint8)), r"\(H, W, 3\) or \(H, W, 4\)"),
        (lambda: Texture(pixels=np.zeros((4, 4, 3))), "dtype float64; uint8"),
        (lambda: Camera(xy_from_world=np.eye(4)[:3], width=1, height=1), "0 0 0 1"),
        (lambda: Camera(xy_from_world=AFFINE, width=0, height=1), "positive"),
        (lambda: Camera(xy_from_world=AFFINE, width=1.5, height=1), "int was expected"),
        (lambda: Head(mesh=None, shape=[], expression=[]), "Mesh was expected"),
        (
            lambda: Head(mesh=Mesh(**TRIANGLE, vertex_attributes={"scalp": np.ones(3)}), shape=[], expression=[]),
            "float32",
        ),
        (lambda: Recipe(method=""), "a name"),
        (lambda: Recipe(method="a\0b"), "without NUL"),
        (lambda: Recipe(method="a", inputs={"\ud800": 1}), "Unicode"),
        (lambda: Recipe(method="a", seed=2**63), "64 bits"),
        (lambda: Recipe(method="a", parameters={"x": float("nan")}), "not a number"),
        (lambda: Recipe(method="portrait", parameters={"sizes": [1, 2]}), "number, truth value or text"),
    ],
)
def test_other_records_refuse(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_equality_is_bit_by_bit():
    assert two_strands() == two_strands()
    assert two_strands() != two_strands(points=POINTS + np.float32(1e-6) * (POINTS == 0))
    assert two_strands() != Camera(xy_from_world=AFFINE, width=1, height=1)


def test_negative_zero_is_zero():
    camera = Camera(xy_from_world=[[-0.0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]], width=1, height=1)
    assert not np.signbit(camera.xy_from_world).any()
    assert str(Recipe(method="a", parameters={"x": -0.0}).parameters["x"]) == "0.0"


def test_records_are_picklable():
    strands = two_strands(point_attributes={"alpha": np.ones(5)})
    assert pickle.loads(pickle.dumps(strands)) == strands


def test_record_names_are_unique():
    assert len({kind.__name__ for kind in RECORDS}) == len(RECORDS)
