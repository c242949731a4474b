"""Stored records come back bit for bit; foreign files and other fingerprints are refused."""

import json
from dataclasses import dataclass

import numpy as np
import pytest

from tress.base.errors import FormatError, InputError
from tress.base.report import Event, StageReport
from tress.io.fingerprint import fingerprint
from tress.io.photo import Photo
from tress.io.record_file import load_header, load_record, save_record
from tress.io.stage_cache import StageCache


def example() -> StageReport:
    """A record of Tress whose `numbers` hold one of everything that can be stored."""
    numbers = {
        "array": np.array([[1.5, np.nan]], np.float32),
        "empty": np.zeros((0, 3), np.int64),
        "flags": np.array([True, False]),
        "nested": Event("begin", "trace", 0.25),
        "several": (1, "two", None, True, [3.5]),
    }
    return StageReport("example", 0.5, numbers, ["a"])  # type: ignore[arg-type]


def test_a_record_comes_back_bit_for_bit(tmp_path):
    save_record(tmp_path / "a.npz", example(), header={"stage": "x"})
    loaded, header = load_record(tmp_path / "a.npz")
    assert header == load_header(tmp_path / "a.npz") == {"stage": "x"}
    assert type(loaded) is StageReport
    assert fingerprint(loaded) == fingerprint(example())
    assert loaded.numbers["array"].dtype == np.float32
    assert loaded.numbers["several"] == (1, "two", None, True, [3.5])


@dataclass(frozen=True)
class Foreign:
    """Not a record of Tress."""

    value: int = 1


def test_only_records_of_tress_are_stored_and_made(tmp_path):
    with pytest.raises(TypeError, match="not a record of Tress"):
        save_record(tmp_path / "a.npz", Foreign())
    for name in ("os:system", "tress.io.record_file:load_record", "tress.absent:Thing"):
        tree = {"header": {}, "tree": {"class": name, "fields": {}}}
        np.savez(tmp_path / "a.npz", __tree__=np.array(json.dumps(tree)))
        with pytest.raises(FormatError, match="run the stage again"):
            load_record(tmp_path / "a.npz")


@pytest.mark.parametrize("content", [b"", b"text", b"PK\x03\x04" + bytes(30)])
def test_damaged_files_are_refused(tmp_path, content):
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(FormatError, match="run the stage again"):
        load_record(tmp_path / "a.npz")


def test_cache_gives_back_only_what_was_made_from_the_same(tmp_path):
    cache = StageCache(tmp_path / "stages")
    cache.save(example(), number=3, name="matte", fingerprint="one")
    assert fingerprint(cache.load(number=3, name="matte", fingerprint="one")) == fingerprint(example())
    with pytest.raises(InputError, match="start from matte or earlier"):
        cache.load(number=3, name="matte", fingerprint="two")
    with pytest.raises(InputError, match=r"04_trace\.npz is missing"):
        cache.load(number=4, name="trace", fingerprint="one")


def test_fingerprints_tell_values_apart():
    values = [
        1,
        1.0,
        "1",
        None,
        (1,),
        (1, 2),
        ((1,), 2),
        {"a": 1},
        np.array([1]),
        np.array([1], np.uint8),
        np.array([[1]]),
        Event("begin", "x"),
        Event("end", "x"),
        Photo,
    ]
    assert len({fingerprint(value) for value in values}) == len(values)
    assert fingerprint("ab", "c") != fingerprint("a", "bc")
