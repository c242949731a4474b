"""OBJ: strands and meshes back to the bit, files of others read as far as they hold either, damaged ones refused."""

from time import process_time

import numpy as np
import pytest
from documents import meshes, strands
from hypothesis import given, settings
from hypothesis import strategies as st

from tress.base.errors import FormatError
from tress.io import obj_lines
from tress.io.formats.obj import decode_obj, encode_obj
from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.strands import Strands

QUICK = settings(max_examples=60, deadline=None)
SQUARE = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@QUICK
@given(strands(least=1, in_gamut=True), meshes(textured=False).filter(lambda mesh: len(mesh.triangles)))
def test_strands_and_meshes_come_back(hair, mesh):
    found = decode_obj(encode_obj(Scene(strands={"hair": hair}, meshes={"head": mesh})))
    assert list(found) == ["head", "hair"]
    assert found["hair"].points.tobytes() == hair.points.tobytes()
    assert found["hair"].offsets.tolist() == hair.offsets.tolist()
    bare = Mesh(positions=mesh.positions, triangles=mesh.triangles, corner_uv=mesh.corner_uv)
    assert found["head"] == bare


def test_colours_come_back_nearly():
    color = np.random.default_rng(0).random((4, 3))
    hair = Strands(points=np.zeros((4, 3)), offsets=[0, 4], point_attributes={"color": color})
    found = decode_obj(encode_obj(Scene(strands={"hair": hair})))["hair"]
    assert np.abs(found.point_attributes["color"] - color).max() < 2e-4


def test_polygons_become_fans_and_numbers_may_count_backwards():
    for face in (b"f 1 2 3 4\n", b"f -4 -3 -2 -1\n", b"f 1//1 2//1 3//1 4//1\n"):
        found = decode_obj(SQUARE + face)["object"]
        assert found.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
        assert found.corner_uv is None


def test_objects_of_one_name_are_kept_apart_and_names_made_plain():
    text = SQUARE + b"o my hair\nl 1 2\no my hair\nl 3 4 1\no 2nd\nf 1 2 3\n"
    found = decode_obj(text)
    assert list(found) == ["my_hair", "my_hair_2", "_2nd"]
    assert found["my_hair_2"].points.tolist() == [[1, 1, 0], [0, 1, 0], [0, 0, 0]]
    assert found["_2nd"].positions.shape == (3, 3)


def test_texture_coordinates_follow_the_fan():
    found = decode_obj(SQUARE + b"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")["object"]
    assert found.corner_uv.tolist() == [[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"v 0 0\n", "Line 1 of the OBJ file"),
        (b"v 0 zero 0\n", "Line 1"),
        (SQUARE + b"l 1 5\n", "Line 5"),
        (SQUARE + b"l 0 1\n", "Line 5"),
        (SQUARE + b"l 1 -5\n", "Line 5"),
        (SQUARE + b"f 1 2\n", "Line 5"),
        (SQUARE + b"f 1/1 2/2 3/3\n", "Line 5"),
        (SQUARE + b"l 1\n", "at least 2"),
        (b"v 0 0 nan\nv 0 0 0\nl 1 2\n", "not finite"),
        (b"v 0 0 0 nan 0 0\nv 0 0 0 1e40 0 0\nl 1 2\n", "not finite"),
        (b"v 0 0 1e300\nv 0 0 0\nl 1 2\n", "not finite"),
    ],
)
def test_wrong_files_are_refused_in_a_sentence(text, message):
    with pytest.raises(FormatError, match=message):
        decode_obj(text)


@settings(max_examples=200, deadline=None)
@given(st.lists(st.lists(st.sampled_from(["v", "vt", "f", "l", "o", "1", "-1", "1/1", "0.5", "nan", "é"])), max_size=8))
def test_any_text_is_refused_or_read(lines):
    text = "\n".join(" ".join(line) for line in lines)
    try:
        decode_obj(text.encode())
    except FormatError as error:
        assert "\n" not in str(error)


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=100))
def test_noise_does_no_harm(noise):
    try:
        decode_obj(noise)
    except FormatError as error:
        assert "\n" not in str(error)


PIECES = ["v 1 2 3", "v 1 2 3 0.1 0.2 0.3", "v -1e-3 .5 +2", "v 1 2", "v 1 2 x", "v 1 2 3 4", "v  1\t2  3 ", "v1 2 3"]
PIECES += [
    "l 1 2",
    "l 2 1 3",
    "l 1 -1",
    "l 1/1 2/2",
    "l 0 1",
    "l",
    "l 1 9",
    "",
    " v 1 2 3",
    "o a",
    "vt 0 1",
    "v 1 2 3-4",
]


@settings(max_examples=300, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(PIECES), st.integers(1, 4))), st.sampled_from(["\n", "\r\n", "\r"]))
def test_runs_are_read_as_line_by_line(pieces, newline):
    text = newline.join(line for line, count in pieces for _ in range(count)).encode()

    def outcome() -> object:
        try:
            return decode_obj(text)
        except FormatError as error:
            return str(error)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(obj_lines.Run, "numbers", lambda run: None)
        slowly = outcome()
    assert outcome() == slowly


def test_fifty_thousand_strands_are_written_and_read_in_a_few_seconds():
    count, points = 50_000, 40
    rows = np.random.default_rng(0).normal(size=(count * points, 3)) * 0.1
    hair = Strands(points=rows, offsets=np.arange(count + 1) * points, point_attributes={"color": np.abs(rows)})
    start = process_time()
    data = encode_obj(Scene(strands={"hair": hair}))
    written = process_time()
    found = decode_obj(data)["hair"]
    assert written - start < 3  # 0.8 s; number by number takes 5 s
    assert process_time() - written < 9  # 3 s; line by line takes 7 s
    assert found.points.tobytes() == hair.points.tobytes()


def test_a_whole_body_is_read(open_data):
    found = decode_obj(open_data("heads/makehuman_mpfb2_base.obj").read_bytes())
    assert sum(len(mesh.triangles) for mesh in found.values()) > 20_000
