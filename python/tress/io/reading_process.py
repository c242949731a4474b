"""The other side of `tress.io.apart`: a process that reads files one after the other until its input ends."""

import contextlib
import os
import pickle
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tress.base.errors import TressError


def serve() -> None:
    """Answers every request on standard input, a pickled function and what it needs, on standard output."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the other side decides
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what libraries print is no answer
    with contextlib.suppress(EOFError):
        while True:
            read, path, folder, memory_bytes = pickle.load(sys.stdin.buffer)
            os.chdir(folder)
            _limit_memory(memory_bytes)
            answers.write(_answer(read, path))
            answers.flush()


def _answer(read: Callable[[Path], Any], path: Path) -> bytes:
    """The pickled result and error."""
    try:
        return pickle.dumps((read(path), ""))
    except TressError as error:
        return pickle.dumps((None, str(error)))
    except MemoryError:
        return pickle.dumps((None, f"{path} is damaged: reading it takes too much memory."))
    except Exception as error:  # whatever a library makes of damage; the other side tells the user
        return pickle.dumps((None, f"{path} is damaged ({type(error).__name__})."))


def _limit_memory(more_bytes: int) -> None:
    """Lets this process have so much memory beyond what it has, where the system can do that."""
    try:
        import resource

        pages = int(Path("/proc/self/statm").read_text().split()[0])
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + more_bytes, hard))
    except (ImportError, OSError, ValueError):
        pass
