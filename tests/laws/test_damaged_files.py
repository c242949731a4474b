"""Every reader bears any damage: bytes cut off, or changed give a result or one sentence, in a bounded time.

A format in the list is read here from the day it is there; readers of other files stand in `READERS`.
"""

import json
from collections.abc import Callable
from datetime import timedelta
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image
from small_portrait import portrait

from tress.base.errors import InputError
from tress.base.report import StageReport
from tress.head.hand_points import read_hand_points
from tress.image.strokes import read_strokes
from tress.io.format import Format
from tress.io.formats.registry import FORMATS
from tress.io.photo import read_photo
from tress.io.record_file import load_record, save_record
from tress.methods.portrait.depth_strokes import read_depth_strokes

SIZE = (80, 96)
Writer, Reader = Callable[[Path], object], Callable[[Path], object]


def picture(kind: str, mode: str, path: Path) -> None:
    """A picture of a kind; smooth noise, so that every part of the decoder has work."""
    noise = Image.fromarray(np.random.default_rng(0).integers(0, 255, (8, 8, 3), np.uint8))
    noise.resize(SIZE[::-1], Image.Resampling.BICUBIC).convert(mode).save(path, kind)


def words(content: object, path: Path) -> None:
    """JSON."""
    path.write_text(json.dumps(content))


def of_format(form: Format, suffix: str) -> tuple[str, Writer, Reader]:
    """The suffix, how a small portrait is written, and how it is read."""
    assert form.read is not None
    return suffix, partial(form.write, portrait()), form.read


STROKE = {"layer": "hair", "width": 9, "points": [[4, 10], [40, 10.5]]}
READERS: dict[str, tuple[str, Writer, Reader]] = {
    **{form.name + suffix: of_format(form, suffix) for form in FORMATS if form.read for suffix in form.suffixes},
    "photo.jpg": (".jpg", partial(picture, "JPEG", "RGB"), read_photo),
    "photo.png": (".png", partial(picture, "PNG", "RGBA"), read_photo),
    "photo.tif": (".tif", partial(picture, "TIFF", "CMYK"), read_photo),
    "photo.gif": (".gif", partial(picture, "GIF", "P"), read_photo),
    "photo.webp": (".webp", partial(picture, "WEBP", "RGB"), read_photo),
    "strokes.json": (".json", partial(words, {"strokes": [STROKE]}), partial(read_strokes, shape=SIZE)),
    "strokes.png": (".png", partial(picture, "PNG", "RGB"), partial(read_strokes, shape=SIZE)),
    "landmarks.json": (
        ".json",
        partial(words, {"right_eye": [30, 30], "left_eye": [50, 30.5], "chin": [40, 70]}),
        read_hand_points,
    ),
    "depths.json": (
        ".json",
        partial(words, {"strokes": [{"depth_m": 0.1, "width": 4, "points": [[4, 10], [40, 10]]}]}),
        partial(read_depth_strokes, shape=SIZE, scale=(1.0, 1.0)),
    ),
    "stage.npz": (
        ".npz",
        lambda path: save_record(path, StageReport("trace", 0.5, {"lengths": np.arange(40.0)}, ["short"])),  # type: ignore[dict-item]
        load_record,
    ),
}


@st.composite
def damages(draw: st.DrawFn) -> Callable[[bytes], bytes]:
    """What happens to a file: some of its bytes change, and its end may be lost."""
    places = draw(st.lists(st.tuples(st.floats(0, 1, exclude_max=True), st.integers(1, 255)), max_size=6))
    end = draw(st.one_of(st.just(1.0), st.floats(0, 1)))

    def damaged(data: bytes) -> bytes:
        changed = bytearray(data)
        for place, bits in places:
            changed[int(place * len(changed))] ^= bits
        return bytes(changed[: round(end * len(changed))])

    return damaged


@pytest.fixture(scope="module")
def whole_files(tmp_path_factory) -> dict[str, bytes]:
    """The bytes of one whole file for each reader."""
    folder = tmp_path_factory.mktemp("whole")
    found = {}
    for name, (suffix, write, read) in READERS.items():
        write(folder / f"file{suffix}")
        read(folder / f"file{suffix}")
        found[name] = (folder / f"file{suffix}").read_bytes()
    return found


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", READERS)
@settings(
    max_examples=60,
    deadline=timedelta(seconds=60),
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(damage=damages())
def test_damage_gives_a_result_or_one_sentence(name, whole_files, tmp_path, damage):
    suffix, _, read = READERS[name]
    path = tmp_path / f"file{suffix}"
    path.write_bytes(damage(whole_files[name]))
    try:
        read(path)
    except InputError as error:
        assert "\n" not in str(error)
