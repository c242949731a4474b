"""A file that harms its reader is refused in a sentence, and the next one is read."""

import os

import hostile_readers
import pytest

from tress.base.errors import FormatError
from tress.io import apart


@pytest.fixture
def reader(monkeypatch):
    """A reader of this test's own, ended with it."""
    own = apart._Reader()
    monkeypatch.setattr(apart, "_reader", own)
    yield own
    own.close()


@pytest.fixture
def file(tmp_path):
    """A text."""
    (tmp_path / "a.txt").write_text("text")
    return tmp_path / "a.txt"


@pytest.mark.parametrize(
    ("read", "message"),
    [
        (hostile_readers.crash, "crashed or ran out of memory"),
        (hostile_readers.take_memory, "too much memory"),
        (hostile_readers.never_end, "took too long"),
    ],
)
def test_harm_is_refused_and_the_next_file_is_read(reader, file, monkeypatch, read, message):
    assert apart.read_apart(file, hostile_readers.say) == "text"
    with monkeypatch.context() as impatient:
        if read is hostile_readers.never_end:
            impatient.setattr(apart, "SECONDS", 0.5)
        with pytest.raises(FormatError, match=message) as caught:
            apart.read_apart(file, read)
    assert "\n" not in str(caught.value)
    assert apart.read_apart(file, hostile_readers.say) == "text"


def test_a_process_that_died_is_replaced(reader, file):
    apart.read_apart(file, hostile_readers.say)
    assert reader._process is not None
    reader._process.kill()
    reader._process.wait()
    assert apart.read_apart(file, hostile_readers.say) == "text"


def test_paths_are_those_of_the_caller(reader, file, monkeypatch):
    from pathlib import Path

    apart.read_apart(file, hostile_readers.say)
    monkeypatch.chdir(file.parent)
    assert apart.read_apart(Path("a.txt"), hostile_readers.say) == "text"
    assert os.getcwd() == str(file.parent)
