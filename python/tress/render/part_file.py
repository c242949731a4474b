"""Films that appear whole or not at all."""

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tress.base.errors import OutputError


@contextmanager
def part_of(path: Path) -> Iterator[Path]:
    """A temporary path beside `path`, with its suffix, a file or a folder; it takes its place when the body ends well.

    A folder replaces one that is there. Raises `OutputError` for any `OSError` of the body; what was at `path` stays.
    """
    temporary = path.with_name(f".{path.stem}.{secrets.token_hex(4)}.part{path.suffix}")
    try:
        yield temporary
        _replace(temporary, path)
    except OSError as error:
        raise OutputError(f"{path} could not be written: {(error.strerror or str(error)).lower()}.") from error
    finally:
        _remove(temporary)


def _replace(temporary: Path, path: Path) -> None:
    if not (temporary.is_dir() and path.is_dir()):
        os.replace(temporary, path)
        return
    old = path.with_name(f".{path.stem}.{secrets.token_hex(4)}.old")
    os.replace(path, old)
    os.replace(temporary, path)
    _remove(old)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    elif path.parent.is_dir():
        path.unlink(missing_ok=True)
