"""The main job from the command line: what it writes, that it can be rerun, and that it is the same every time."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hostile_files import save_alpha, save_cmyk, save_deep, save_grey, save_palette, save_turned
from PIL import Image

from tress.io.record_file import load_record
from tress.methods.portrait.pipeline import STAGES

SMALL = ("--strands", "400", "--no-turntable", "--formats", "hair", "--max-size", "224", "--set", "depth.voxel=0.006")


@pytest.fixture(scope="module")
def photo(tmp_path_factory, astronaut) -> Path:
    """The astronaut as a PNG."""
    path = tmp_path_factory.mktemp("photo") / "astronaut.png"
    astronaut.save(path)
    return path


@pytest.fixture(scope="module")
def finished(tmp_path_factory, photo) -> Path:
    """The folder of one small run, by a process of its own on one thread."""
    folder = tmp_path_factory.mktemp("finished") / "out"
    ended = run_apart("portrait", photo, "-o", folder, *SMALL, "--json", threads=1)
    assert ended.returncode == 0, ended.stderr
    (folder.parent / "said.json").write_text(ended.stdout)
    return folder


def run_apart(*arguments: object, threads: int) -> subprocess.CompletedProcess[str]:
    """`tress` in a process of its own."""
    environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
    command = [sys.executable, "-c", "from tress.app.cli import main; main()", *map(str, arguments)]
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120)


def test_every_stage_leaves_a_picture_and_a_result(finished):
    for number, stage in enumerate(STAGES, start=1):
        name = finished / "stages" / f"{number:02d}_{stage.name}"
        picture = np.asarray(Image.open(name.with_suffix(".png")))
        assert picture.std() > 1, f"{name} shows nothing"
        if stage is not STAGES[-1]:  # no stage begins after the last
            load_record(name.with_suffix(".npz"))


def test_json_lists_what_was_written(finished):
    said = json.loads((finished.parent / "said.json").read_text())
    written = {str(path.relative_to(finished)): path.stat().st_size for path in finished.rglob("*") if path.is_file()}
    assert said["files"] == written
    assert {"hair.hair", "report.json"} <= set(written)
    assert [stage.name for stage in STAGES] == [name for name in names(said["stages"]) if name in names_of_stages()]


def test_the_report_holds_times_figures_versions_and_parameters(finished):
    report = json.loads((finished / "report.json").read_text())
    assert report["seed"] == 0
    assert report["versions"]["tress"]
    assert report["parameters"]["trace.health"] == 5
    assert all(stage["duration_secs"] > 0 for stage in report["stages"])
    assert set(names_of_stages()) <= set(names(report["stages"]))


def names(stages: list[dict]) -> list[str]:
    return [stage["name"] for stage in stages]


def names_of_stages() -> list[str]:
    return [stage.name for stage in STAGES]


def test_two_threads_give_the_same_bits(finished, photo, tmp_path):
    ended = run_apart("portrait", photo, "-o", tmp_path / "out", *SMALL, threads=2)
    assert ended.returncode == 0, ended.stderr
    assert (tmp_path / "out" / "hair.hair").read_bytes() == (finished / "hair.hair").read_bytes()


@pytest.mark.parametrize("stage", ["layers", "trace"])
def test_a_rerun_from_a_stage_gives_the_same_bits(tress, finished, photo, tmp_path, stage):
    folder = copied(finished, tmp_path / "out")
    (folder / "hair.hair").unlink()
    said = tress("portrait", photo, "-o", folder, *SMALL, "--from-stage", stage)
    assert said.code == 0, said.err
    assert (folder / "hair.hair").read_bytes() == (finished / "hair.hair").read_bytes()
    assert "together" in said.out and "left from" not in said.out
    report = json.loads((folder / "report.json").read_text())
    assert "head" not in names(report["stages"])


def test_a_rerun_refuses_results_of_other_parameters(tress, finished, photo, tmp_path):
    folder = copied(finished, tmp_path / "out")
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    said = tress("portrait", photo, "-o", folder, *SMALL, "--from-stage", "trace", "--set", "layers.rounds=2")
    assert said.code == 2
    assert "start from layers or earlier" in said.err
    assert before == {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_a_later_parameter_takes_effect_in_a_rerun(tress, finished, photo, tmp_path):
    folder = copied(finished, tmp_path / "out")
    arguments = ["--from-stage", "trace", "--set", "trace.min_length_px=20"]
    assert tress("portrait", photo, "-o", folder, *SMALL, *arguments).code == 0
    changed, _ = load_record(folder / "stages" / "05_trace.npz")
    kept, _ = load_record(finished / "stages" / "05_trace.npz")
    assert changed.count < kept.count


def copied(source: Path, target: Path) -> Path:
    import shutil

    shutil.copytree(source, target)
    return target


def test_a_rerun_leaves_no_picture_of_the_last_run(tress, finished, photo, tmp_path):
    folder = copied(finished, tmp_path / "out")
    arguments = ("portrait", photo, "-o", folder, *SMALL, "--formats", "usda")
    said = tress(*arguments, "--from-stage", "color")
    assert said.code == 0, said.err
    assert "left from an earlier run: hair.hair\n" in said.out
    (folder / "textures" / "mine.png").write_bytes(b"kept")
    first = sorted((folder / "textures").iterdir())
    other = ("--from-stage", "head", "--max-size", "200")  # another texture
    assert tress(*arguments, *other).code == 0
    second = sorted((folder / "textures").iterdir())
    assert len(first) == len(second) == 2
    assert first != second and set(first) & set(second) == {folder / "textures" / "mine.png"}
    assert (folder / "hair.usda").exists() and not (folder / "hair.usdc").exists()


@pytest.mark.parametrize(
    ("save", "ending"),
    [
        (save_cmyk, "tif"),
        (save_deep, "png"),
        (save_grey, "jpg"),
        (save_palette, "png"),
        (save_alpha, "png"),
        (save_turned, "jpg"),
    ],
)
def test_unusual_pictures_work(tress, tmp_path, astronaut, save, ending):
    path = save(tmp_path / f"photo.{ending}", astronaut)
    said = tress("portrait", path, "-o", tmp_path / "out", *SMALL, "--quiet")
    assert said.code == 0, said.err
    assert said.out == ""
    assert (tmp_path / "out" / "hair.hair").stat().st_size > 128


def test_strokes_change_the_layers(tress, finished, photo, tmp_path):
    folder = copied(finished, tmp_path / "out")
    before, _ = load_record(folder / "stages" / "02_layers.npz")
    side = Image.open(photo).height
    stroke = {"layer": "background", "width": side / 8, "points": [[0, 0], [side, 0]]}
    (tmp_path / "strokes.json").write_text(json.dumps({"strokes": [stroke]}))
    hair = {"layer": "hair", "width": 9, "points": [[20, side - 20], [60, side - 20]]}
    (tmp_path / "strokes.json").write_text(json.dumps({"strokes": [stroke, hair]}))
    arguments = ["--strokes", tmp_path / "strokes.json", "--from-stage", "layers"]
    assert tress("portrait", photo, "-o", folder, *SMALL, *arguments).code == 0
    after, _ = load_record(folder / "stages" / "02_layers.npz")
    row, column = int(after.label.shape[0] * (1 - 20 / side)), int(after.label.shape[1] * 40 / side)
    assert (before.label[row, column], after.label[row, column]) == (1, 3)
