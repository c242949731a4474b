"""Files and folders of results appear whole or not at all, whatever goes wrong in between."""

import errno
import os
import signal
import subprocess
import sys
import textwrap

import pytest

from tress.base.errors import OutputError
from tress.io import atomic
from tress.io.atomic import OutputFolder, atomic_path, write_bytes

ACCIDENTS = [KeyboardInterrupt(), MemoryError(), ValueError("a mistake"), SystemExit(1)]
FULL = OSError(errno.ENOSPC, "No space left on device")


def names(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_a_file_is_replaced(tmp_path):
    write_bytes(tmp_path / "a.hair", b"old")
    write_bytes(tmp_path / "a.hair", b"new")
    assert (tmp_path / "a.hair").read_bytes() == b"new"
    assert names(tmp_path) == ["a.hair"]


@pytest.mark.parametrize("accident", ACCIDENTS, ids=lambda accident: type(accident).__name__)
def test_an_accident_leaves_the_old_file(tmp_path, accident):
    path = tmp_path / "a.hair"
    path.write_bytes(b"old")
    with pytest.raises(type(accident)), atomic_path(path) as temporary:
        temporary.write_bytes(b"half")
        raise accident
    assert (path.read_bytes(), names(tmp_path)) == (b"old", ["a.hair"])


@pytest.mark.parametrize("step", ["_sync", "replace"])
def test_a_full_disk_leaves_the_old_file(tmp_path, monkeypatch, step):
    path = tmp_path / "a.hair"
    path.write_bytes(b"old")

    def full(*_):
        raise FULL

    monkeypatch.setattr(atomic if step == "_sync" else os, step, full)
    with pytest.raises(OutputError, match=r"could not be written: no space left on device; nothing was changed\.$"):
        write_bytes(path, b"new")
    assert (path.read_bytes(), names(tmp_path)) == (b"old", ["a.hair"])


@pytest.mark.parametrize("place", ["file/a.hair", "absent/a.hair", "folder"])
def test_impossible_places_are_refused_in_one_sentence(tmp_path, place):
    (tmp_path / "file").write_text("")
    (tmp_path / "folder").mkdir()
    with pytest.raises(OutputError) as caught:
        write_bytes(tmp_path / place, b"new")
    assert "\n" not in str(caught.value)
    assert names(tmp_path) == ["file", "folder"]


def test_a_new_folder_appears_with_everything_in_it(tmp_path):
    out = tmp_path / "deep" / "out"
    with OutputFolder(out) as folder:
        (folder.path / "stages").mkdir()
        (folder.path / "stages" / "a.png").write_bytes(b"a")
        (folder.path / "report.json").write_bytes(b"{}")
        assert not out.exists()
    assert names(out) == ["report.json", "stages", "stages/a.png"]
    assert names(tmp_path / "deep") == ["out", "out/report.json", "out/stages", "out/stages/a.png"]


def test_in_an_old_folder_files_are_replaced_and_others_stay(tmp_path):
    out = tmp_path / "out"
    (out / "stages").mkdir(parents=True)
    (out / "stages" / "a.png").write_bytes(b"old")
    (out / "notes.txt").write_bytes(b"mine")
    with OutputFolder(out) as folder:
        (folder.path / "stages").mkdir()
        (folder.path / "stages" / "a.png").write_bytes(b"new")
        (folder.path / "stages" / "b.png").write_bytes(b"b")
        assert (out / "stages" / "a.png").read_bytes() == b"old"
    assert names(tmp_path) == ["out", "out/notes.txt", "out/stages", "out/stages/a.png", "out/stages/b.png"]
    assert (out / "stages" / "a.png").read_bytes() == b"new"
    assert (out / "notes.txt").read_bytes() == b"mine"


@pytest.mark.parametrize("there", [True, False])
@pytest.mark.parametrize("accident", [*ACCIDENTS, FULL], ids=lambda accident: type(accident).__name__)
def test_an_accident_leaves_the_folder_as_it_was(tmp_path, accident, there):
    out = tmp_path / "a" / "out"
    if there:
        out.mkdir(parents=True)
        (out / "hair.usdc").write_bytes(b"old")
    before = names(tmp_path)
    expected = OutputError if accident is FULL else type(accident)
    with pytest.raises(expected), OutputFolder(out) as folder:
        (folder.path / "hair.usdc").write_bytes(b"half")
        raise accident
    assert names(tmp_path) == before
    assert not there or (out / "hair.usdc").read_bytes() == b"old"


def test_an_error_in_reading_something_else_is_not_taken_for_one_in_writing(tmp_path):
    with pytest.raises(FileNotFoundError), OutputFolder(tmp_path / "out"):
        (tmp_path / "absent.jpg").read_bytes()


def test_a_target_that_is_a_file_is_refused_before_any_work(tmp_path):
    (tmp_path / "out").write_text("")
    for target in (tmp_path / "out", tmp_path / "out" / "deeper"):
        with pytest.raises(OutputError, match="could not be written"), OutputFolder(target):
            raise AssertionError("the body must not run")
    assert names(tmp_path) == ["out"]


def test_a_folder_in_the_place_of_a_file_is_seen_before_anything_is_moved(tmp_path):
    out = tmp_path / "out"
    (out / "b.png").mkdir(parents=True)
    with pytest.raises(OutputError, match="folder of that name"), OutputFolder(out) as folder:
        (folder.path / "a.png").write_bytes(b"a")
        (folder.path / "b.png").write_bytes(b"b")
    assert names(out) == ["b.png"]


@pytest.mark.parametrize("suffix", [".usdc", ".glb", ".hair", ".ply", ".obj", ".npz"])
def test_every_format_survives_a_disk_that_is_really_full(tmp_path, suffix):
    """A limit on the size of files stands for the full disk: the kernel refuses the write half-way."""
    script = f"""
        import resource, signal, sys
        from pathlib import Path
        import numpy as np
        from tress.base.errors import OutputError
        from tress.io.formats.registry import format_of
        from tress.model.camera import Camera
        from tress.model.document import Document
        from tress.model.strands import Strands
        points = np.random.default_rng(0).random((20_000, 3))
        camera = Camera(xy_from_world=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]], width=1, height=1)
        hair = Strands(points=points, offsets=np.arange(0, 20_001, 10))
        path = Path({str(tmp_path / "hair")!r} + {suffix!r})
        path.write_bytes(b"old")
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))
        try:
            format_of(path).write(Document({{"hair": hair, "photo": camera}}), path)
        except OutputError as error:
            print(error)
            sys.exit(7)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 7, done.stderr
    assert len(done.stdout.splitlines()) == 1
    assert names(tmp_path) == [f"hair{suffix}"]
    assert (tmp_path / f"hair{suffix}").read_bytes() == b"old"


def test_ctrl_c_leaves_nothing(tmp_path):
    script = f"""
        import sys, time
        from pathlib import Path
        from tress.io.atomic import OutputFolder
        with OutputFolder(Path({str(tmp_path / "out")!r})) as folder:
            (folder.path / "hair.hair").write_bytes(b"half")
            print("ready", flush=True)
            time.sleep(30)
    """
    running = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(script)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert running.stdout.readline() == "ready\n"
    running.send_signal(signal.SIGINT)
    _, errors = running.communicate(timeout=30)
    assert "KeyboardInterrupt" in errors
    assert names(tmp_path) == []
