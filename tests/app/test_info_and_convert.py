"""`tress info` and `tress convert` over every format in the list."""

import itertools
import json

import numpy as np
import pytest
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
        (["info", "hair.glb"], 2, "writes but does not read"),
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


def test_errors_are_json_where_that_was_asked_for(tress, saved):
    said = tress("convert", saved, saved.with_name("hair.fbx"), "--json")
    assert json.loads(said.out)["exit_code"] == said.code == 2
