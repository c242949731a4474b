"""The user's corrections from files, in pixels of the photo as the user has it, to those that the stages see."""

from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError
from tress.head.hand_points import HandPoints, read_hand_points
from tress.head.landmarks import FaceLandmarks
from tress.image.strokes import read_strokes
from tress.io.photo import Photo
from tress.methods.portrait.corrections import Corrections
from tress.methods.portrait.depth_strokes import read_depth_strokes


@dataclass(frozen=True)
class CorrectionFiles:
    """Files and choices of the user; None where nothing was given."""

    face: int | None = None
    landmarks: Path | None = None
    strokes: Path | None = None
    depth_strokes: Path | None = None


def read_corrections(files: CorrectionFiles, *, photo: Photo) -> Corrections:
    """The corrections for `photo`. Raises `InputError` where a file cannot be used."""
    return Corrections(
        face=files.face,
        landmarks=None if files.landmarks is None else _landmarks(files.landmarks, photo),
        strokes=None if files.strokes is None else _strokes(files.strokes, photo),
        depth_strokes=None if files.depth_strokes is None else _depth_strokes(files.depth_strokes, photo),
    )


def _landmarks(path: Path, photo: Photo) -> HandPoints:
    """The points at the size of the stages."""
    scale = _scale(photo)
    points = read_hand_points(path)
    if isinstance(points, FaceLandmarks):
        return replace(points, points=points.points * np.array([*scale, scale[0]], np.float32))
    return {name: (x * scale[0], y * scale[1]) for name, (x, y) in points.items()}


def _scale(photo: Photo) -> tuple[float, float]:
    """What takes pixels of the photo as the user has it to those that the stages see, in x and y."""
    height, width = photo.pixels.shape[:2]
    return width / photo.original_width, height / photo.original_height


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


def _depth_strokes(path: Path, photo: Photo) -> NDArray[np.float32]:
    height, width = photo.pixels.shape[:2]
    return read_depth_strokes(path, shape=(height, width), scale=_scale(photo))
