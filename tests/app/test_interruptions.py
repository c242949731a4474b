"""Whatever stops the work half-way, the folder is afterwards as it was before."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

SMALL = (
    "--strands",
    "400",
    "--no-turntable",
    "--formats",
    "hair,usdc",
    "--max-size",
    "224",
    "--set",
    "depth.voxel=0.006",
    "--quiet",
)
LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv.pop(1)), resource.RLIM_INFINITY))
from tress.app.cli import main
main()
"""


@pytest.fixture
def photo(tmp_path, astronaut) -> Path:
    """The astronaut in a folder of its own."""
    (tmp_path / "photos").mkdir()
    astronaut.save(tmp_path / "photos" / "a.png")
    return tmp_path / "photos" / "a.png"


@pytest.fixture
def results(tmp_path) -> Path:
    """An empty folder."""
    (tmp_path / "results").mkdir()
    return tmp_path / "results"


def test_a_folder_below_a_file_cannot_be_written(tress, photo, results):
    (results / "file").write_text("kept")
    said = tress("portrait", photo, "-o", results / "file" / "out")
    assert said.code == 3
    assert said.err.count("\n") == 1
    assert (results / "file").read_text() == "kept"


def test_a_file_in_place_of_the_folder_is_kept(tress, photo, results):
    (results / "out").write_text("kept")
    assert tress("portrait", photo, "-o", results / "out").code == 3
    assert (results / "out").read_text() == "kept"
    assert len(list(results.iterdir())) == 1


@pytest.mark.skipif(not Path("/proc/self").is_dir(), reason="a file system without writing is needed")
def test_a_file_system_without_writing(tress, photo):
    said = tress("portrait", photo, "-o", "/proc/tress")
    assert said.code == 3
    assert "/proc/tress could not be written" in said.err


@pytest.mark.parametrize("limit", [1_000, 50_000, 400_000])
@pytest.mark.parametrize("existing", [False, True])
def test_a_full_disk_leaves_everything_as_it_was(photo, results, limit, existing):
    if existing:
        (results / "out").mkdir()
        (results / "out" / "hair.hair").write_text("old")
    before = contents(results)
    command = [sys.executable, "-c", LIMITED, str(limit), "portrait", str(photo), "-o", str(results / "out"), *SMALL]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert ended.returncode == 3, ended.stderr
    assert ended.stderr.startswith("tress: ")
    assert ended.stderr.count("\n") == 1
    assert contents(results) == before


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_leaves_nothing(photo, results, number):
    command = [sys.executable, "-c", "from tress.app.cli import main; main()", "portrait", str(photo)]
    process = subprocess.Popen([*command, "-o", str(results / "out"), *SMALL], stderr=subprocess.PIPE, text=True)
    wait_for(lambda: any(results.iterdir()))
    process.send_signal(number)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130, said
    assert "nothing was written" in said
    assert "Traceback" not in said
    assert list(results.iterdir()) == []


def wait_for(condition, *, timeout_secs: float = 60.0) -> None:
    """Waits until the condition holds."""
    end = time.monotonic() + timeout_secs
    while not condition():
        assert time.monotonic() < end, "the work never began"
        time.sleep(0.005)


def contents(folder: Path) -> dict[str, bytes | None]:
    """Every file and folder below `folder`, with its bytes."""
    paths = sorted(folder.rglob("*"))
    return {os.fspath(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in paths}
