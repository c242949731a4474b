"""Films of every kind: their frames come back, and they appear whole or not at all."""

import stat

import numpy as np
import pytest
from PIL import Image

from tress.base.errors import InputError, OutputError
from tress.render.films import FILMS, write_films
from tress.render.gif import write_gif
from tress.render.mp4 import write_mp4
from tress.render.png_sequence import write_png_sequence

FRAMES = [np.full((16, 24, 3), 20 * number, np.uint8) for number in range(12)]
WITHOUT_FFMPEG = [kind for kind in FILMS if kind != "mp4"]


def broken(error):
    yield FRAMES[0]
    raise error


def program(folder, words):
    """An ffmpeg that does what the words of the shell say."""
    path = folder / "ffmpeg"
    path.write_text(f"#!/bin/sh\nfor last; do :; done\n{words}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


def test_a_gif_has_its_frames_and_lasts_as_long(tmp_path):
    assert write_gif(tmp_path / "a.gif", frames=FRAMES, frames_per_sec=18.0) == 12
    with Image.open(tmp_path / "a.gif") as film:
        assert film.n_frames == 12 and film.info["loop"] == 0
        lasted = 0
        for number, frame in enumerate(FRAMES):
            film.seek(number)
            lasted += film.info["duration"]
            np.testing.assert_array_equal(np.asarray(film.convert("RGB")), frame)
    assert lasted == pytest.approx(12_000 / 18, abs=5.1)


def test_pictures_of_a_sequence_come_back_with_their_transparency(tmp_path):
    clear = [np.dstack([frame, frame[..., :1] // 2]) for frame in FRAMES]
    assert write_png_sequence(tmp_path / "film", frames=clear) == 12
    found = sorted((tmp_path / "film").iterdir())
    assert [path.name for path in found[:2]] == ["0001.png", "0002.png"] and len(found) == 12
    np.testing.assert_array_equal(np.asarray(Image.open(found[5])), clear[5])


def test_a_sequence_takes_the_place_of_a_longer_one(tmp_path):
    write_png_sequence(tmp_path / "film", frames=FRAMES)
    write_png_sequence(tmp_path / "film", frames=FRAMES[:3])
    assert len(list((tmp_path / "film").iterdir())) == 3 and [p.name for p in tmp_path.iterdir()] == ["film"]


def test_mp4_without_ffmpeg_says_so_before_a_frame_is_made(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match="needs the program ffmpeg, which is not on the PATH"):
        write_films(tmp_path, name="a", kinds=["webm", "mp4"], frames=broken(AssertionError()))
    assert list(tmp_path.iterdir()) == []


def test_mp4_goes_through_the_users_ffmpeg(tmp_path, monkeypatch):
    program(tmp_path, 'cat > "$last"')
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    assert write_mp4(tmp_path / "a.mp4", frames=FRAMES) == 12
    assert (tmp_path / "a.mp4").read_bytes() == b"".join(frame.tobytes() for frame in FRAMES)


def test_what_ffmpeg_complains_of_is_passed_on(tmp_path, monkeypatch):
    program(tmp_path, "cat > /dev/null; echo no such codec >&2; exit 1")
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    with pytest.raises(OutputError, match="no such codec"):
        write_mp4(tmp_path / "a.mp4", frames=FRAMES)
    assert [path.name for path in tmp_path.iterdir()] == ["ffmpeg"]


@pytest.mark.parametrize("kind", WITHOUT_FFMPEG)
@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError])
def test_nothing_is_left_of_a_film_that_fails(tmp_path, kind, error):
    with pytest.raises(error):
        write_films(tmp_path, name="a", kinds=[kind], frames=broken(error()))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("kind", WITHOUT_FFMPEG)
def test_films_without_frames_or_with_others_are_refused(tmp_path, kind):
    for frames in ([], [np.zeros((16, 24), np.uint8)], [np.zeros((16, 24, 3))]):
        with pytest.raises(InputError):
            write_films(tmp_path, name="a", kinds=[kind], frames=frames)
    with pytest.raises(OutputError, match="could not be written"):
        write_films(tmp_path / "absent", name="a", kinds=[kind], frames=FRAMES)
    assert list(tmp_path.iterdir()) == []


def test_an_unknown_kind_is_refused(tmp_path):
    with pytest.raises(InputError, match="no film 'avi'; one of webm, gif, mp4, png"):
        write_films(tmp_path, name="a", kinds=["avi"], frames=FRAMES)
