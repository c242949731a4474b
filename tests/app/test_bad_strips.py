"""Strips that cannot be: one clear sentence at the command line and in Python, and nothing is written."""

from dataclasses import replace

import numpy as np
import pytest
from foreign_patch import foreign
from strip_hair import BASE

from tress.base.errors import InputError
from tress.io.formats.registry import format_of
from tress.methods.strips.levels import level_chain
from tress.methods.strips.presets.registry import preset_of
from tress.model.document import Document
from tress.model.strip import Strip
from tress.model.strip_shapes import flat_strip

FLAT = flat_strip(length_m=0.1, width_m=0.01)
ALONG, ACROSS = FLAT.weights.shape
HOLE = np.where(np.arange(12)[:, None] == 5, np.float32(np.nan), np.zeros((12, 3), np.float32))

FILES = {
    "decreasing knots": ({"uKnots": [0, 0, 0, 0, 1, 1, 0.5, 1]}, "decreases"),
    "too few knots": ({"uKnots": [0, 0, 0, 0, 1, 1, 1]}, "7 uKnots for 4 points of order 4; 8"),
    "a weight of zero": ({"pointWeights": [1.0] * 11 + [0.0]}, "above 0"),
    "a negative weight": ({"pointWeights": [1.0] * 11 + [-2.0]}, "above 0"),
    "a point that is no number": ({"points": HOLE}, "not finite"),
    "a weight that is no number": ({"pointWeights": [1.0] * 11 + [float("nan")]}, "not finite"),
    "a ragged net": ({"uVertexCount": 5, "uKnots": [0, 0, 0, 0, 0.5, 1, 1, 1, 1]}, "12 points or weights for 5 x 3"),
    "a degree above the points": ({"uOrder": 6, "uKnots": [0] * 5 + [1] * 5}, "degree"),
}

STRIPS = {
    "decreasing knots": ({"knots_u": FLAT.knots_u[::-1].copy()}, "decrease"),
    "too few knots": ({"knots_u": np.linspace(0, 1, ALONG)}, "knots_u"),
    "a weight of zero": ({"weights": np.zeros((ALONG, ACROSS))}, "above 0"),
    "a point that is no number": ({"points": np.full((ALONG, ACROSS, 3), np.nan)}, "not finite|NaN|finite"),
    "a ragged net": ({"points": FLAT.points[:-1]}, "expected"),
    "a degree above the points": ({"knots_u": np.repeat([0.0, 1.0], ALONG + 1)}, "degree|knots"),
}


@pytest.mark.parametrize("command", ["info", "lod", "keyframes"])
@pytest.mark.parametrize("what", FILES)
def test_files_with_such_strips_are_refused_in_one_line(tress, tmp_path, what, command):
    changes, message = FILES[what]
    foreign(tmp_path / "bad.usda", **changes)
    options = () if command == "info" else ("-o", tmp_path / "out")
    said = tress(command, tmp_path / "bad.usda", *options)
    assert said.code == 2 and said.err.startswith("tress: ") and said.err.count("\n") == 1, said.err
    assert message in said.err and "lock" in said.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("what", STRIPS)
def test_such_strips_are_refused_in_python(what):
    changes, message = STRIPS[what]
    with pytest.raises(InputError, match=message) as caught:
        replace(FLAT, **changes)
    assert len(str(caught.value).splitlines()) == 1


def test_ragged_lists_are_refused_in_a_sentence():
    with pytest.raises(InputError, match="points"):
        Strip(points=[[[0, 0, 0]], [[0, 0, 0], [1, 0, 0]]], weights=[[1]], knots_u=[0, 0, 1, 1], knots_v=[0, 1])  # type: ignore[arg-type]


def test_a_triangle_outside_the_scalp_is_refused(tress, tmp_path):
    path = tmp_path / "hair.usda"
    format_of(path).write(Document(BASE), path)
    path.write_text(path.read_text().replace("tress:triangle = 91", "tress:triangle = 99999"))
    said = tress("lod", path, "-o", tmp_path / "out")
    assert said.code == 2 and said.err.count("\n") == 1 and "99999" in said.err
    root = BASE["b"].root
    for triangle in (99999, -1):
        with pytest.raises(InputError, match=str(triangle)):
            Document({**BASE, "b": replace(BASE["b"], root=replace(root, triangle=triangle))})


def test_a_budget_below_a_triangle_a_strip_is_refused(tress, tmp_path):
    path = tmp_path / "hair.usdc"
    format_of(path).write(Document(BASE), path)
    said = tress("lod", path, "-o", tmp_path / "out", "--lod", "500,1", "--keep-all")
    assert said.code == 2 and said.err.count("\n") == 1 and "Level 1 has a budget of 1 triangle" in said.err
    with pytest.raises(InputError, match="Level 1 has a budget of 1 triangle"):
        level_chain(Document(BASE), budgets=(500, 1))


def test_an_unknown_preset_is_refused(tress, tmp_path):
    said = tress("strips", "--preset", "mohawk", "-o", tmp_path / "out")
    assert said.code == 2 and said.err.count("\n") == 1 and "mohawk" in said.err and "ponytail" in said.err
    with pytest.raises(InputError, match="mohawk"):
        preset_of("mohawk")
