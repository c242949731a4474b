"""A folder of numbered PNGs, which loses nothing and may be transparent: what compositing programs read."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from tress.base.errors import InputError
from tress.render.part_file import part_of

Array = np.ndarray[Any, Any]


def write_png_sequence(
    path: Path,
    *,
    frames: Iterable[Array],
    frames_per_sec: float = 18.0,  # noqa: ARG001 (all writers of films take it)
) -> int:
    """Writes frames (H, W, 3 | 4) uint8 sRGB as path/0001.png and so on, and returns their number.

    The folder appears whole or not at all, in place of one that is there. `frames_per_sec` is of no use to pictures.
    Raises `InputError` for no frames and for frames of another kind, `OutputError` where it cannot be written.
    """
    count = 0
    with part_of(path) as temporary:
        temporary.mkdir()
        for count, frame in enumerate(frames, 1):
            if frame.dtype != np.uint8 or frame.ndim != 3 or frame.shape[2] not in (3, 4):
                raise InputError(
                    f"Frame {count - 1} is {frame.dtype} {frame.shape}; uint8 (H, W, 3 or 4) was expected."
                )
            Image.fromarray(frame).save(temporary / f"{count:04d}.png", compress_level=4)
        if count == 0:
            raise InputError("The film has no frames; at least one was expected.")
    return count
