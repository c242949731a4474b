"""`tress lod` and `tress keyframes`: what they write, and what they say of wrong input."""

import json
from pathlib import Path

import numpy as np
import pytest
from ball_hair import ball_hair
from glb_reader import parsed
from gltf_validator import validator_report
from PIL import Image

from tress.io.formats.registry import format_of
from tress.model.evaluate import evaluate
from tress.model.keyframes import Keyframes
from tress.render.video import read_video


@pytest.fixture(scope="module")
def hair(tmp_path_factory):
    path = tmp_path_factory.mktemp("hair") / "hair.usdc"
    format_of(path).write(ball_hair(24), path)
    return path


def test_levels_are_files_that_agree_with_their_description(tress, hair, tmp_path):
    said = tress("lod", hair, "-o", tmp_path / "out", "--lod", "1200,200", "--padding", 8, "--pixels", 40, "--json")
    assert said.code == 0, said.err
    described = json.loads((tmp_path / "out" / "lod.json").read_text())
    assert len(described["levels"]) == 2
    for level, budget in zip(described["levels"], (1200, 200), strict=True):
        report = validator_report(tmp_path / "out" / level["file"])
        assert report["issues"]["messages"] == []
        assert report["info"]["totalTriangleCount"] == level["triangles"] <= budget
    assert described["levels"][0]["takeover_m"] == 0 < described["levels"][1]["takeover_m"]
    assert described["levels"][1]["likeness"]["silhouette_iou"] > 0.7
    found = json.loads(said.out)
    lines = {stage["name"]: stage["numbers"] for stage in found["stages"]}
    assert lines["level 1"]["strips"] == described["levels"][1]["strips"] and lines["level 1"]["triangles"] <= 200
    sheet = np.asarray(Image.open(tmp_path / "out" / "preview.png"))
    for half in np.array_split(sheet[2 * len(sheet) // 3 :][8:400], 2, axis=1):
        assert len(np.unique(half[:, 16:-16].reshape(-1, 3), axis=0)) > 20
    assert set(found["files"]) == {
        *("hair.glb", "hair_lod0.glb", "hair_lod1.glb", "lod.json", "preview.png", "report.json")
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--lod", "many"), "whole numbers with commas"),
        (("--lod", "10,20"), "positive numbers that fall"),
        (("--lod", "40", "--keep-all"), "24 strips that must stay; at least 48"),
        (("--lod", "40", "--keep-all"), "(all stay, as asked)"),
        (("--lod", "1"), "(one of every group and atlas stays)"),
        (("--alpha", "dither"), "one of mask, blend"),
        (("--padding", "abc"), "Invalid value for '--padding'"),
    ],
)
def test_wrong_levels_are_refused_in_one_line(tress, hair, tmp_path, arguments, message):
    said = tress("lod", hair, "-o", tmp_path / "out", *arguments)
    assert said.code == 2 and message in said.err and said.err.count("\n") == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("motion", ["sway", "wind"])
@pytest.mark.parametrize("interpolation", ["cubic", "linear"])
def test_motions_keep_roots_move_tips_and_repeat(tress, hair, tmp_path, motion, interpolation):
    options = (
        "--no-turntable",
        "--motion",
        motion,
        "--amplitude",
        0.03,
        "--period",
        1.5,
        "--interpolation",
        interpolation,
    )
    said = tress("keyframes", hair, "-o", tmp_path / "out", *options)
    assert said.code == 0, said.err
    document = format_of(tmp_path / "out" / "hair.usdc").read(tmp_path / "out" / "hair.usdc")
    assert {item.interpolation for item in document.of_type(Keyframes).values()} == {interpolation}
    mesh = {time: evaluate(document, time).meshes["crown"] for time in (0.0, 0.4, 1.5)}
    along = mesh[0.0].vertex_attributes["fraction"][:, 0]
    moved = np.linalg.norm(mesh[0.4].positions - mesh[0.0].positions, axis=1)
    assert moved[along == 0].max() < 1e-6 and 0.003 < moved[along == 1].mean() < 0.06
    assert np.allclose(mesh[1.5].positions, mesh[0.0].positions, atol=1e-6)
    glb, arrays, _ = parsed((tmp_path / "out" / "hair.glb").read_bytes())
    (clip,) = glb["animations"]
    assert arrays[clip["samplers"][0]["input"]].max() == pytest.approx(1.5)
    assert validator_report(tmp_path / "out" / "hair.glb")["issues"]["messages"] == []


def test_keyframes_come_from_json_and_old_ones_go(tress, hair, tmp_path):
    moments = {"target": "crown", "times": [0, 1], "values": [[0, 0, 0], [0, 0.01, 0]], "interpolation": "step"}
    (tmp_path / "up.json").write_text(json.dumps({**moments, "frame": "head"}))
    assert tress("keyframes", hair, "-o", tmp_path / "first", "--no-turntable").code == 0
    moving = tmp_path / "first" / "hair.usdc"
    said = tress(
        "keyframes", moving, "-o", tmp_path / "out", "--from", tmp_path / "up.json", "--clear", "--no-turntable"
    )
    assert said.code == 0, said.err
    document = format_of(moving).read(tmp_path / "out" / "hair.usdc")
    (found,) = document.of_type(Keyframes).values()
    assert found.interpolation == "step" and found.values.shape == (2, 1, 1, 3)
    up = [evaluate(document, time).meshes["sides"].positions[:, 1].mean() for time in (0.5, 1.0)]
    assert up[1] - up[0] == pytest.approx(0.01, abs=1e-5)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{", "is not JSON"),
        ("[3]", "entry 0 is no object"),
        ('{"target": "crown", "times": [0, 0], "values": [[0, 0, 0], [0, 0, 0]]}', "rising seconds"),
        ('{"target": "crown", "times": [0], "values": [[0, 0, 0]], "speed": 2}', "entry 0 has speed"),
        ('{"target": "nobody", "times": [0], "values": [[0, 0, 0]]}', "'nobody' is no strip or group"),
        ('{"target": "crown", "times": [0], "values": [[0, 0], [1]]}', "entry 0 cannot be used"),
    ],
)
def test_wrong_keyframes_are_refused_in_one_line(tress, hair, tmp_path, content, message):
    (tmp_path / "bad.json").write_text(content)
    said = tress("keyframes", hair, "-o", tmp_path / "out", "--from", tmp_path / "bad.json")
    assert said.code == 2 and message in said.err and said.err.count("\n") == 1


def test_an_unknown_motion_and_target_are_refused(tress, hair, tmp_path):
    assert "one of sway, wind" in tress("keyframes", hair, "-o", tmp_path / "out", "--motion", "earthquake").err
    said = tress("keyframes", hair, "-o", tmp_path / "out", "--target", "nobody")
    assert "'nobody'" in said.err and "its groups are crown, sides" in said.err
    said = tress("keyframes", hair, "-o", tmp_path / "out", "--style", "oil")
    assert said.code == 2 and "one of" in said.err and "textured" in said.err
    said = tress("keyframes", hair, "-o", tmp_path / "out", "--amplitude", "abc")
    assert said.code == 2 and said.err.startswith("tress: ") and "Invalid value for '--amplitude'" in said.err
    assert said.err.count("\n") == 1


def test_a_changed_file_is_told_and_read(tress, hair, tmp_path):
    document = format_of(hair).read(hair)
    path = tmp_path / "hair.usda"
    format_of(path).write(document, path)
    path.write_text(path.read_text().replace("int64 tress:region = 0", "int64 tress:region = 1"))
    said = tress("info", path)
    assert (
        said.code == 0
        and said.err == f"tress: {path} was changed after Tress wrote it: by another program, or by damage.\n"
    )
    assert tress("info", hair).err == ""


def test_a_file_without_its_textures_says_what_is_missing(tress, hair, tmp_path):
    (tmp_path / "alone.usdc").write_bytes(hair.read_bytes())
    said = tress("info", tmp_path / "alone.usdc")
    assert said.code == 2 and "the folder textures belongs beside the file and moves with it" in said.err


def test_motions_add_up_and_play_on_film(tress, hair, tmp_path):
    options = ("--target", "crown", "--period", 0.3, "--amplitude", 0.05)
    assert tress("keyframes", hair, "-o", tmp_path / "one", "--no-turntable", *options).code == 0
    said = tress("keyframes", tmp_path / "one" / "hair.usdc", "-o", tmp_path / "two", *options)
    assert said.code == 0, said.err
    found = format_of(Path("hair.usdc")).read(tmp_path / "two" / "hair.usdc").of_type(Keyframes)
    assert len(found) == 2 and {item.target for item in found.values()} == {"crown"}
    frames, rate = read_video(tmp_path / "two" / "turntable.webm")
    assert len(frames) == pytest.approx(4.2 * rate, abs=1) and frames.std() > 10
    assert {"hair.usdc", "hair.glb", "preview.png", "report.json"} <= {p.name for p in (tmp_path / "two").iterdir()}
