"""The user's corrections from files, in pixels of the photo as the user has it, to those that the stages see."""

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError
from tress.image.strokes import read_strokes
from tress.io.photo import Photo
from tress.methods.portrait.corrections import Corrections


@dataclass(frozen=True)
class CorrectionFiles:
    """Files and choices of the user; None where nothing was given."""

    face: int | None = None
    landmarks: Path | None = None
    strokes: Path | None = None
    depth_strokes: Path | None = None


def read_corrections(files: CorrectionFiles, *, photo: Photo) -> Corrections:
    """The corrections for `photo`. Raises `InputError` where a file cannot be used."""
    return Corrections(face=files.face, strokes=None if files.strokes is None else _strokes(files.strokes, photo))


def _strokes(path: Path, photo: Photo) -> NDArray[np.uint8]:
    """The strokes at the size of the stages; drawn on the photo, or painted on a picture of the stages' size."""
    working = photo.pixels.shape[:2]
    try:
        strokes = read_strokes(path, shape=(photo.original_height, photo.original_width))
    except InputError:
        if path.suffix.lower() == ".json" or not path.is_file():
            raise
        return read_strokes(path, shape=working)
    if strokes.shape == working:
        return strokes
    shrunk = cv2.resize(strokes, working[::-1], interpolation=cv2.INTER_NEAREST)
    return np.asarray(shrunk, np.uint8)
