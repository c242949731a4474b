"""`tress strips`: what it writes, that it is the same every time, and what it says of wrong input."""

import json

import pytest
from PIL import Image

from tress.head.assets import DATA
from tress.io.formats.registry import format_of
from tress.model.atlas import Atlas
from tress.model.head import Head
from tress.model.recipe import Recipe
from tress.model.strip import Strip

pytestmark = pytest.mark.skipif(not (DATA / "head.npz").is_file(), reason="`make assets` has not built the head")

FEW = ("--strips", 60, "--no-turntable", "--quiet")


def test_it_writes_document_mesh_picture_and_report(tress, tmp_path):
    out = tmp_path / "out"
    said = tress("strips", "--preset", "short_crop", "-o", out, "--seed", 4, "--color", "#a5793f", *FEW)
    assert (said.code, said.out, said.err) == (0, "", "")
    document = format_of(out / "hair.usdc").read(out / "hair.usdc")
    assert len(document.of_type(Strip)) > 40 and len(document.of_type(Head)) == 1
    (atlas,), (recipe,) = document.of_type(Atlas), document.of_type(Recipe).values()
    assert {strip.atlas for strip in document.of_type(Strip).values()} == {atlas}
    assert recipe.seed == 4 and recipe.parameters["color"] == "#a5793f"
    assert document.of_type(Head)["head"].mesh.vertex_attributes["color"].shape[1] == 3
    report = json.loads((out / "report.json").read_text())
    numbers = {stage["name"]: stage["numbers"] for stage in report["stages"]}
    assert report["parameters"]["color"] == "#a5793f"
    assert report["preset"] == "short_crop" and numbers["push out"]["left_inside"] == 0
    width, height = Image.open(out / "preview.png").size
    assert width > 3 * height
    assert (out / "hair.glb").stat().st_size > 100_000
    assert not (out / "turntable.webm").exists()


def test_a_saved_head_carries_the_hair_and_json_is_one_object(tress, tmp_path):
    assert tress("strips", "--preset", "bob", "-o", tmp_path / "a", "--formats", "usdc", *FEW).code == 0
    again = ("strips", "--preset", "bob", "--head", tmp_path / "a" / "hair.usdc", "-o", tmp_path / "b")
    said = tress(*again, "--formats", "usdc", "--strips", 60, "--no-turntable", "--json")
    assert said.code == 0 and json.loads(said.out)["ok"]
    first, second = (format_of(path).read(path) for path in (tmp_path / name / "hair.usdc" for name in "ab"))
    assert first == second


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--preset", "bobb"], "There is no preset 'bobb'; did you mean bob? one of long_straight,"),
        (["--strips", 5], "strips is 5"),
        (["--color", "red"], "no colour"),
        (["--head", "absent.usdc"], "does not exist"),
        (["--formats", "xyz"], "xyz"),
        (["--formats", "usdc,ply"], ".ply holds strands alone, not strips; some of usdc"),
        (["--formats", " ,"], "names no format"),
    ],
)
def test_wrong_input_gets_one_sentence_and_leaves_nothing(tress, tmp_path, arguments, words):
    said = tress("strips", "-o", tmp_path / "out", *arguments)
    assert said.code == 2 and words in said.err and said.err.count("\n") <= 2
    assert not (tmp_path / "out").exists()
