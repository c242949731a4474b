"""`tress texture`: what it writes, that it is the same every time, and what it says of wrong input."""

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tress.app.hex_color import hex_of_linear, linear_of_hex
from tress.base.report import Report
from tress.io.formats.registry import format_of
from tress.model.atlas import Atlas
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_atlas import strand_atlas

SMALL = ("--resolution", 128, "--variations", 3, "--padding", 4, "--strands", 40, "--thickness", 0.06, "--seed", 7)


@pytest.fixture
def finished(tress, tmp_path) -> Path:
    said = tress("texture", "-o", tmp_path / "out", *SMALL)
    assert said.code == 0, said.err
    return tmp_path / "out"


def pixels(path: Path) -> np.ndarray:
    return np.asarray(Image.open(path))


def test_every_map_is_a_picture_of_the_size_of_the_atlas(finished):
    described = json.loads((finished / "atlas.json").read_text())
    for name in described["maps"]:
        picture = pixels(finished / f"{name}.png")
        assert picture.shape[:2] == (described["height"], described["width"])
        assert picture.dtype == np.uint8 and picture.std() > 1, name
    assert Image.open(finished / "color.png").mode == "RGBA"
    assert (pixels(finished / "alpha.png") == pixels(finished / "color.png")[..., 3]).all()


def test_pictures_document_and_library_agree(finished):
    params = TextureParams(resolution=128, variations=3, padding=4, strands=40, thickness=0.06, seed=7)
    document = finished / "atlas.usdc"
    atlas = format_of(document).read(document).of_type(Atlas)["atlas"]
    # The command's colours are those of the library to one byte, as hexadecimal digits keep them.
    drawn = strand_atlas(params, report=Report())
    assert np.abs(atlas.color.astype(int) - drawn.color).max() <= 2
    assert (atlas.maps["normal"] == drawn.maps["normal"]).all()
    assert (pixels(finished / "color.png") == atlas.color).all()
    assert all((pixels(finished / f"{name}.png") == values).all() for name, values in atlas.maps.items())


def test_the_description_says_where_the_cards_are(finished):
    described = json.loads((finished / "atlas.json").read_text())
    alpha = pixels(finished / "alpha.png").copy()
    for variation in described["variations"]:
        left, top, width, height = variation["px"]
        assert alpha[top : top + height, left : left + width].any()
        alpha[top : top + height, left : left + width] = 0
        u_low, v_low, u_high, v_high = variation["uv"]
        assert [u_low * 128, (1 - v_high) * described["height"]] == [left, top]
        assert [u_high * 128, (1 - v_low) * described["height"]] == [left + width, top + height]
    assert not alpha.any()


def test_mips_are_the_levels_that_the_description_lists(finished):
    described = json.loads((finished / "atlas.json").read_text())
    for number, level in enumerate(described["levels"][1:], start=1):
        for name in described["maps"]:
            picture = pixels(finished / "mips" / f"{name}_{number}.png")
            assert picture.shape[:2] == (level["height"], level["width"])
    assert len(list((finished / "mips").iterdir())) == len(described["maps"]) * (len(described["levels"]) - 1)


def test_the_report_says_size_and_coverage(finished):
    report = json.loads((finished / "report.json").read_text())
    figures = {name: value for stage in report["stages"] for name, value in stage["numbers"].items()}
    assert figures["width"] == 128 and figures["variations"] == 3
    assert 0 <= figures["largest_coverage_error"] < 0.05
    assert report["parameters"]["seed"] == 7


def test_the_same_command_writes_the_same_bytes(tress, tmp_path, finished):
    assert tress("texture", "-o", tmp_path / "again", *SMALL, "--threads", 1).code == 0
    for file in sorted(finished.rglob("*.png")):
        assert file.read_bytes() == (tmp_path / "again" / file.relative_to(finished)).read_bytes(), file.name


def test_no_mips_writes_none(tress, tmp_path):
    assert tress("texture", "-o", tmp_path / "out", *SMALL, "--no-mips", "-q").code == 0
    assert not (tmp_path / "out" / "mips").exists()


def test_hair_too_fine_for_the_test_is_reported(tress, tmp_path):
    said = tress("texture", "-o", tmp_path / "out", *SMALL, "--thickness", 0.001)
    assert said.code == 0 and "threshold" in said.err


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (("--resolution", 1000), "power of two"),
        (("--strands", 0), "strands"),
        (("--tip-fade", 1.5), "tip_fade"),
        (("--frizz", "nan"), "frizz"),
        (("--kinds", "core,braid"), "braid"),
        (("--kinds", ","), "kinds"),
        (("--root-color", "brown"), "hexadecimal"),
        (("--variations", 256, "--resolution", 64), "do not fit"),
    ],
)
def test_bad_input_is_one_sentence_and_nothing_is_written(tress, tmp_path, arguments, word):
    said = tress("texture", "-o", tmp_path / "out", *arguments)
    assert said.code == 2 and not (tmp_path / "out").exists()
    assert said.err.startswith("tress: ") and word in said.err and said.err.count("\n") == 1
    assert not said.out


def test_hexadecimal_colours_return():
    for text in ("#000000", "#ffffff", "#3a2415", "#0b0c0d"):
        assert hex_of_linear(linear_of_hex(text)) == text
    assert linear_of_hex("3A2415") == linear_of_hex("#3a2415")
