"""Animated GIF: 256 colours a frame, played again and again."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from tress.base.errors import InputError
from tress.render.part_file import part_of

Array = np.ndarray[Any, Any]

LEAST_CENTISECS = 2
"""Browsers play what is shorter at a tenth of the speed."""


def write_gif(path: Path, *, frames: Iterable[Array], frames_per_sec: float = 18.0) -> int:
    """Writes frames (H, W, 3) uint8 sRGB as GIF and returns their number. The file appears whole or not at all.

    Times are whole hundredths of a second, 2 or more, and chosen so that the film does not drift. Colours are not
    dithered: flat areas stay flat. Holds all frames in 256 colours. Raises `InputError` for no frames and for frames of
    another kind, `OutputError` where the file cannot be written.
    """
    pictures = [_paletted(frame, number) for number, frame in enumerate(frames)]
    if not pictures:
        raise InputError("The film has no frames; at least one was expected.")
    ends = np.round(np.arange(len(pictures) + 1) * 100 / frames_per_sec).astype(int)
    durations = [10 * max(int(length), LEAST_CENTISECS) for length in np.diff(ends)]
    with part_of(path) as temporary:
        pictures[0].save(
            temporary, "gif", save_all=True, append_images=pictures[1:], duration=durations, loop=0, disposal=1
        )
    return len(pictures)


def _paletted(frame: Array, number: int) -> Image.Image:
    if frame.dtype != np.uint8 or frame.ndim != 3 or frame.shape[2] != 3:
        raise InputError(f"Frame {number} is {frame.dtype} {frame.shape}; uint8 (H, W, 3) was expected.")
    return Image.fromarray(frame).quantize(256, dither=Image.Dither.NONE)
