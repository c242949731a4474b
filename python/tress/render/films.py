"""Kinds of films, one a file. A new one is its file and a line here."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final, Protocol

import numpy as np

from tress.base.errors import InputError
from tress.render.gif import write_gif
from tress.render.mp4 import ffmpeg, write_mp4
from tress.render.png_sequence import write_png_sequence
from tress.render.video import write_webm

Array = np.ndarray[Any, Any]


class FilmWriter(Protocol):
    """Writes frames (H, W, 3) uint8 sRGB and returns their number."""

    def __call__(self, path: Path, *, frames: Iterable[Array], frames_per_sec: float = 18.0) -> int:
        """The file, or the folder, appears whole or not at all."""
        ...


FILMS: Final[dict[str, FilmWriter]] = {
    "webm": write_webm,
    "gif": write_gif,
    "mp4": write_mp4,
    "png": write_png_sequence,
}


def checked_films(kinds: Iterable[str]) -> tuple[str, ...]:
    """The kinds, each once. Raises `InputError` for one that there is not, and for MP4 without an ffmpeg."""
    chosen = tuple(dict.fromkeys(kinds))
    for kind in chosen:
        if kind not in FILMS:
            raise InputError(f"There is no film {kind!r}; one of {', '.join(FILMS)} was expected.")
    if "mp4" in chosen:
        ffmpeg()
    return chosen


def write_films(
    folder: Path, *, name: str, kinds: Iterable[str], frames: Iterable[Array], frames_per_sec: float = 18.0
) -> tuple[Path, ...]:
    """Writes the same frames as every kind: folder/name.webm and the like, and the pictures of `png` in folder/name.

    Frames are made once; with several kinds they are all held. Raises what the writers raise.
    """
    chosen = checked_films(kinds)
    shown = frames if len(chosen) == 1 else list(frames)
    paths = tuple(folder / (name if kind == "png" else f"{name}.{kind}") for kind in chosen)
    for kind, path in zip(chosen, paths, strict=True):
        FILMS[kind](path, frames=shown, frames_per_sec=frames_per_sec)
    return paths
