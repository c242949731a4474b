"""Files read in a process apart: a library can crash on a damaged file, never end, or take all memory.

The process is started at the first file and kept, since loading a library costs more than reading most files. It has a
ceiling on memory (where the system knows one) and on time for every file; when it dies, the file is refused, and the
next file gets a new process.
"""

import atexit
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from tress.base.errors import FormatError

T = TypeVar("T")

MEMORY_BYTES, MEMORY_PER_BYTE = 2**30, 8
SECONDS, BYTES_PER_SECOND = 30.0, 1e6
_PROGRAM = "from tress.io.reading_process import serve; serve()"


def read_apart(path: Path, read: Callable[[Path], T]) -> T:
    """What `read(path)` gives, called by another process; `read` is a function of a module.

    Raises `FormatError` like it, and where the file makes the process crash, take more memory than 1 GiB and eight
    times the file's size, or more time than half a minute and a second for each megabyte.
    """
    return _reader.read(path, read)


class _Reader:
    """The process and the pipes to it; one file at a time."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def read(self, path: Path, read: Callable[[Path], Any]) -> Any:
        with self._lock:
            try:
                result, error = _answer(self._running(), path, read)
            except BaseException:
                self.close()
                raise
        if error:
            raise FormatError(error)
        return result

    def _running(self) -> subprocess.Popen[bytes]:
        if self._process is None or self._process.poll() is not None:
            self.close()
            self._process = _started()
        return self._process

    def close(self) -> None:
        """Ends the process."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.communicate()


def _started() -> subprocess.Popen[bytes]:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(entry for entry in sys.path if entry)}
    return subprocess.Popen(
        [sys.executable, "-c", _PROGRAM],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=environment,
    )


def _answer(process: subprocess.Popen[bytes], path: Path, read: Callable[[Path], Any]) -> tuple[Any, str]:
    """The result, or the words of an error."""
    assert process.stdin and process.stdout
    size = path.stat().st_size if path.is_file() else 0
    late = threading.Event()
    watch = threading.Timer(SECONDS + size / BYTES_PER_SECOND, lambda: (late.set(), process.kill()))
    watch.start()
    try:
        pickle.dump((read, path, os.getcwd(), MEMORY_BYTES + MEMORY_PER_BYTE * size), process.stdin)
        process.stdin.flush()
        return pickle.load(process.stdout)
    except (EOFError, OSError, pickle.UnpicklingError):
        reason = "reading it took too long" if late.is_set() else "the reader crashed or ran out of memory on it"
        raise FormatError(f"{path} is damaged: {reason}.") from None
    finally:
        watch.cancel()


_reader = _Reader()
atexit.register(_reader.close)
