"""MP4 by the user's own `ffmpeg`: Tress carries no encoder for it, since the usual one, x264, is under the GPL."""

import shutil
import subprocess
from collections.abc import Iterable
from itertools import chain
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.render.part_file import part_of

Array = np.ndarray[Any, Any]


def write_mp4(path: Path, *, frames: Iterable[Array], frames_per_sec: float = 18.0) -> int:
    """Writes frames (H, W, 3) uint8 sRGB as MP4 in the encoder that the user's `ffmpeg` prefers; returns their number.

    The file appears whole or not at all. Width and height must be even. Raises `InputError` where there is no `ffmpeg`
    on the PATH, before the first frame is made, for no frames and for frames of another kind; `OutputError` where the
    file cannot be written, with what ffmpeg said.
    """
    program = ffmpeg()
    rest = iter(frames)
    first = next(rest, None)
    if first is None:
        raise InputError("The film has no frames; at least one was expected.")
    if first.ndim != 3 or first.shape[2] != 3 or first.shape[0] % 2 or first.shape[1] % 2:
        raise InputError(f"A frame has shape {first.shape}; (H, W, 3) with even H and W was expected.")
    with part_of(path) as temporary:
        command = [program, *_options(first.shape, frames_per_sec), str(temporary)]
        return _piped(command, chain([first], rest), first.shape)


def ffmpeg() -> str:
    """The user's ffmpeg. Raises `InputError` where there is none."""
    found = shutil.which("ffmpeg")
    if found is None:
        raise InputError("MP4 needs the program ffmpeg, which is not on the PATH; install it, or choose webm.")
    return found


def _options(shape: tuple[int, ...], frames_per_sec: float) -> list[str]:
    given = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{shape[1]}x{shape[0]}", "-r", f"{frames_per_sec:g}"]
    wanted = ["-pix_fmt", "yuv420p", "-movflags", "+faststart", "-an"]
    return ["-nostdin", "-loglevel", "error", "-y", *given, "-i", "pipe:0", *wanted]


def _piped(command: list[str], frames: Iterable[Array], shape: tuple[int, ...]) -> int:
    count = 0
    with TemporaryFile() as said:
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said) as process:
            assert process.stdin is not None
            try:
                for frame in frames:
                    if frame.shape != shape or frame.dtype != np.uint8:
                        raise InputError(f"Frame {count} is {frame.dtype} {frame.shape}; uint8 {shape} was expected.")
                    process.stdin.write(np.ascontiguousarray(frame).tobytes())
                    count += 1
                process.stdin.close()
            except BrokenPipeError:
                process.wait()
            except BaseException:
                process.kill()
                raise
        if process.returncode != 0:
            said.seek(0)
            words = " ".join(said.read().decode(errors="replace").split())
            raise OSError(f"ffmpeg said: {words[:200] or process.returncode}")
    return count
