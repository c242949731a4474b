"""Bad input: one line on standard error, the right exit code, nothing written."""

import json

import pytest
from bald_head import bald_head
from hostile_files import png_header, save_grey, truncated_jpeg

MAKERS = {
    "an empty file": lambda folder, picture: (folder / "a.jpg").write_bytes(b"") or folder / "a.jpg",
    "a text file named .jpg": lambda folder, picture: (folder / "a.jpg").write_text("Dear diary") and folder / "a.jpg",
    "a truncated JPEG": lambda folder, picture: truncated_jpeg(folder / "a.jpg", picture),
    "one pixel": lambda folder, picture: save_grey(folder / "a.png", picture.resize((1, 1))),
    "a decompression bomb": lambda folder, picture: png_header(folder / "a.png", width=20_000, height=20_000),
    "an absent file": lambda folder, picture: folder / "absent.jpg",
    "a folder": lambda folder, picture: folder,
}


@pytest.fixture
def rooms(tmp_path):
    """A folder for the photo and an empty one for the results."""
    (tmp_path / "photos").mkdir()
    (tmp_path / "results").mkdir()
    return tmp_path / "photos", tmp_path / "results"


@pytest.mark.parametrize("what", MAKERS)
def test_unusable_photos(tress, rooms, astronaut, what):
    photos, results = rooms
    said = tress("portrait", MAKERS[what](photos, astronaut), "-o", results / "out")
    assert said.code == 2
    assert said.err.startswith("tress: ")
    assert said.err.count("\n") == 1
    assert said.out == ""
    assert list(results.iterdir()) == []


def test_a_picture_without_a_face(tress, rooms, faceless):
    photos, results = rooms
    faceless.save(photos / "a.png")
    said = tress("portrait", photos / "a.png", "-o", results / "out")
    assert said.code == 2
    assert said.err.startswith(("tress: No face was found", "tress: What looked like a face"))
    assert list(results.iterdir()) == []


def test_json_is_all_there_is_on_standard_output(tress, rooms):
    _, results = rooms
    said = tress("portrait", results / "absent.jpg", "-o", results / "out", "--json")
    assert json.loads(said.out)["kind"] == "InputError"
    assert said.code == json.loads(said.out)["exit_code"] == 2


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--from-stage", "hat"], "hat is no stage; one of"),
        (["--strokes", "absent.json"], "absent.json"),
        (["--landmarks", "absent.json"], "absent.json"),
        (["--from-stage", "trace"], "01_head.npz is missing"),
        (["--set", "depth.wait=2"], "names no parameter"),
        (["--formats", "usdc,fbx"], "fbx"),
        (["--face", "7"], "Face 7 was asked for"),
    ],
)
def test_unusable_options(tress, rooms, astronaut, options, message):
    photos, results = rooms
    astronaut.save(photos / "a.png")
    said = tress("portrait", photos / "a.png", "-o", results / "out", *options)
    assert said.code == 2
    assert message in said.err
    assert said.err.count("\n") == 1
    assert list(results.iterdir()) == []


@pytest.mark.parametrize(
    "arguments", [["portrait"], ["portrait", "a.jpg", "--strands", "99"], ["portrait", "--wat"], ["wat"]]
)
def test_wrong_usage_is_two(tress, arguments):
    assert tress(*arguments).code == 2


def test_a_bald_head_has_no_hair(tress, rooms):
    photos, results = rooms
    bald_head().save(photos / "bald.png")
    said = tress("portrait", photos / "bald.png", "-o", results / "out")
    assert said.code == 2
    assert said.err.startswith("tress: No hair was found")
    assert list(results.iterdir()) == []
