"""WebM through OpenCV's bundled FFmpeg (LGPL, with libvpx; there is no x264 in it)."""

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import cv2
import numpy as np

from tress.base.errors import InputError
from tress.render.part_file import part_of

Array = np.ndarray[Any, Any]

CODECS: Final = {"vp8": "VP80", "vp9": "VP90"}
"""VP8 takes a quarter of the time of VP9, for files a third larger; every browser plays both."""


def write_webm(path: Path, *, frames: Iterable[Array], frames_per_sec: float = 18.0, codec: str = "vp8") -> int:
    """Writes frames (H, W, 3) uint8 sRGB as WebM and returns their number.

    The file appears whole or not at all. Width and height must be even, as the codecs want it. Raises `InputError` for
    frames of another kind and for no frames, `OutputError` where the file cannot be written.
    """
    if codec not in CODECS:
        raise InputError(f"codec is {codec!r}; one of {', '.join(CODECS)} was expected.")
    with part_of(path) as temporary:
        return _encode(temporary, frames, frames_per_sec, codec)


def read_video(path: Path) -> tuple[Array, float]:
    """Frames (T, H, W, 3) uint8 sRGB of a video, and its frames a second; for checks of short ones."""
    capture = cv2.VideoCapture(str(path), cv2.CAP_FFMPEG)
    frames = []
    while True:
        read, frame = capture.read()
        if not read:
            break
        frames.append(frame[..., ::-1])
    if not frames:
        raise InputError(f"{path} holds no frames that can be read.")
    return np.stack(frames), float(capture.get(cv2.CAP_PROP_FPS))


def _encode(path: Path, frames: Iterable[Array], frames_per_sec: float, codec: str) -> int:
    writer, shape, count = None, (0, 0, 0), 0
    try:
        for frame in frames:
            if writer is None:
                shape = _checked_shape(frame)
                writer = _writer(path, shape, frames_per_sec, codec)
            if frame.shape != shape or frame.dtype != np.uint8:
                raise InputError(f"Frame {count} is {frame.dtype} {frame.shape}; uint8 {shape} was expected.")
            writer.write(np.ascontiguousarray(frame[..., ::-1]))
            count += 1
    finally:
        if writer is not None:
            writer.release()
    if count == 0:
        raise InputError("The video has no frames; at least one was expected.")
    if not path.exists() or path.stat().st_size == 0:
        raise OSError("the encoder wrote nothing")
    return count


def _checked_shape(frame: Array) -> tuple[int, int, int]:
    if frame.ndim != 3 or frame.shape[2] != 3 or frame.shape[0] % 2 or frame.shape[1] % 2:
        raise InputError(f"A frame has shape {frame.shape}; (H, W, 3) with even H and W was expected.")
    return frame.shape


def _writer(path: Path, shape: tuple[int, int, int], frames_per_sec: float, codec: str) -> cv2.VideoWriter:
    path.touch()  # raises the OSError that OpenCV would swallow
    fourcc = cv2.VideoWriter.fourcc(*CODECS[codec])
    with _silent_stderr():
        writer = cv2.VideoWriter(str(path), cv2.CAP_FFMPEG, fourcc, frames_per_sec, (shape[1], shape[0]))
    if not writer.isOpened():
        raise OSError(f"OpenCV's FFmpeg offers no {codec} encoder")
    return writer


@contextmanager
def _silent_stderr() -> Iterator[None]:
    """Keeps OpenCV from printing, past Python and its own log level, that WebM has no four-letter tags."""
    kept = os.dup(2)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
