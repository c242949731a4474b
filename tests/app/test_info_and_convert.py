"""`tress info` and `tress convert` over every format in the list."""

import itertools
import json
import struct

import numpy as np
import pytest
from ball_hair import ball_hair
from gltf_validator import validator_report
from small_portrait import portrait

from tress.io.format import STRANDS
from tress.io.formats.registry import FORMATS, format_of

READ = [form.suffixes[0] for form in FORMATS if form.read]
WRITTEN = [form.suffixes[0] for form in FORMATS]


@pytest.fixture
def saved(tmp_path):
    """A small portrait as USD."""
    format_of(tmp_path / "hair.usdc").write(portrait(), tmp_path / "hair.usdc")
    return tmp_path / "hair.usdc"


@pytest.mark.parametrize(("source", "target"), list(itertools.product(READ, WRITTEN)))
def test_every_format_is_converted_into_every_other(tress, saved, source, target):
    first, second = saved.with_name(f"first{source}"), saved.with_name(f"second{target}")
    assert tress("convert", saved, first, "--quiet").code == 0
    said = tress("convert", first, second)
    if target == ".npz" and source not in (".usdc", ".npz"):
        assert (said.code, second.exists()) == (2, False)
        assert "0 cameras" in said.err
        return
    assert said.code == 0, said.err
    assert said.out.startswith(str(second))
    form = format_of(second)
    if form.read and STRANDS in form.keeps:
        found = form.read(second).records["hair"]
        assert found.points.tobytes() == portrait().records["hair"].points.tobytes()


@pytest.mark.parametrize("suffix", READ)
def test_info_tells_of_the_strands(tress, saved, suffix):
    path = saved.with_name(f"other{suffix}")
    tress("convert", saved, path)
    said = tress("info", path)
    assert said.code == 0, said.err
    assert "60 strands" in said.out and "…" not in said.out
    fields = json.loads(tress("info", path, "--json").out)
    assert fields["bytes"] == path.stat().st_size
    assert fields["records"]["hair"]["offsets"] == "int64 61"


def test_info_measures_the_strands(tress, tmp_path):
    from tress.model.document import Document
    from tress.model.strands import Strands

    points = [[0, 0, 0], [0, 0.1, 0], [0, 0.1, 0.1], [5, 5, 5], [5, 5, 5.4]]
    hair = Strands(points=points, offsets=[0, 3, 5], point_attributes={"alpha": np.ones(5)})
    format_of(tmp_path / "a.hair").write(Document({"hair": hair}), tmp_path / "a.hair")
    said = tress("info", tmp_path / "a.hair").out
    assert "2 strands, 2 to 3 points each, 30 cm long in the mean; alpha" in said


def test_info_lists_every_field_when_asked(tress, saved):
    said = tress("info", saved, "-v").out
    assert "point_attributes.color" in said and "parameters.strands" in said
    assert "parameters.strands" not in tress("info", saved).out


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["info", "absent.usdc"], 2, "does not exist"),
        (["info", "hair.glb"], 2, "does not begin as one"),
        (["convert", "hair.glb", "other.usdc"], 2, "writes but does not read"),
        (["info", "hair.fbx"], 2, "one of .usdc"),
        (["convert", "hair.usdc", "hair.fbx"], 2, "one of .usdc"),
        (["convert", "hair.usdc", "absent/hair.ply"], 3, "could not be written"),
        (["convert", "hair.usdc"], 2, "target"),
    ],
)
def test_what_cannot_be_done_is_said(tress, saved, monkeypatch, arguments, code, message):
    monkeypatch.chdir(saved.parent)
    for name in ("hair.glb", "hair.fbx"):
        saved.with_name(name).write_bytes(b"glTF")
    before = sorted(saved.parent.iterdir())
    said = tress(*arguments)
    assert said.code == code
    assert message.lower() in said.err.lower()
    assert sorted(saved.parent.iterdir()) == before


@pytest.mark.parametrize("suffix", [form.suffixes[0] for form in FORMATS if form.strands_alone])
def test_strips_are_not_converted_into_an_empty_file(tress, tmp_path, suffix):
    path = tmp_path / "strips.usdc"
    format_of(path).write(ball_hair(6), path)
    said = tress("convert", path, path.with_suffix(suffix))
    assert said.code == 2 and "6 strips and no strands" in said.err and said.err.count("\n") == 1
    assert not path.with_suffix(suffix).exists()
    assert tress("convert", path, path.with_suffix(".obj")).code == 0


def test_errors_are_json_where_that_was_asked_for(tress, saved):
    said = tress("convert", saved, saved.with_name("hair.fbx"), "--json")
    assert json.loads(said.out)["exit_code"] == said.code == 2


def test_info_tells_what_a_glb_holds(tress, tmp_path):
    path = tmp_path / "hair.glb"
    format_of(path).write(ball_hair(12, moving=True), path)
    said = tress("info", path)
    assert said.code == 0, said.err
    assert "strips_lod0" in said.out and "morph targets" in said.out and "2.00 s" in said.out
    found = json.loads(tress("info", path, "--json").out)
    report = validator_report(path)["info"]
    triangles = [
        int(p["holds"].split(", ")[1].split()[0].replace(",", "")) for p in found["parts"] if p["kind"] == "mesh"
    ]
    assert sum(triangles) == report["totalTriangleCount"] and found["bytes"] == path.stat().st_size


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "does not begin as one"),
        (b"glTF" + bytes(16), "does not begin as one"),
        (struct.pack("<4sIII4s", b"glTF", 1, 20, 0, b"JSON"), "glTF 1"),
        (struct.pack("<4sIII4s", b"glTF", 2, 20, 9, b"JSON") + b"[]", "cannot be read"),
        (
            struct.pack("<4sIII4s", b"glTF", 2, 20, 99, b"JSON") + b'{"meshes": [{"primitives": [{}]}]}',
            "cannot be read",
        ),
        (struct.pack("<4sIII4s", b"glTF", 2, 20, 2**31, b"JSON") + b"[" * 99999, "cannot be read"),
    ],
)
def test_damaged_glb_files_are_refused_in_one_line(tress, tmp_path, data, message):
    path = tmp_path / "bad.glb"
    path.write_bytes(data)
    said = tress("info", path)
    assert said.code == 2 and message in said.err and said.err.count("\n") == 1


def test_endings_that_can_be_read_are_named(tress, tmp_path):
    (tmp_path / "a.txt").write_text("hair")
    said = tress("info", tmp_path / "a.txt")
    assert said.code == 2 and ".usdc" in said.err and ".glb" not in said.err


def test_info_of_strips_is_short(tress, tmp_path):
    format_of(tmp_path / "hair.usdc").write(ball_hair(30, moving=True), tmp_path / "hair.usdc")
    said = tress("info", tmp_path / "hair.usdc")
    assert said.code == 0 and len(said.out.splitlines()) < 12, said.out
    assert "30 of them; -v shows each" in said.out and "control points, 2 groups" in said.out
    assert "moments from 0 to 2 s for" in said.out and "px, " in said.out
    assert len(tress("info", tmp_path / "hair.usdc", "-v").out.splitlines()) > 100
