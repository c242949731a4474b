"""Files that appear whole or not at all.

A writer works on a temporary sibling, which is synced and moved into place by one `rename`; whatever goes wrong before,
the old file stays as it was and the sibling is removed. `OutputFolder` does the same for a set of files: they are all
written before the first is moved.
"""

import errno
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tress.base.errors import OutputError

DISK_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EROFS)


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """A temporary path beside `path`, with its suffix, that takes its place when the body ends well.

    Raises `OutputError` for any `OSError` of the body, so nothing but writing belongs there. On any exception, Ctrl-C
    too, the temporary file is removed and what was at `path` stays.
    """
    temporary = path.with_name(f".{path.stem}.{secrets.token_hex(4)}.part{path.suffix}")
    try:
        _check_target(path)
        yield temporary
        _sync(temporary)
        os.replace(temporary, path)
        _sync(path.parent)
    except OSError as error:
        raise OutputError(f"{path} could not be written: {_reason(error)}; nothing was changed.") from error
    finally:
        temporary.unlink(missing_ok=True) if path.parent.is_dir() else None


def write_bytes(path: Path, data: bytes) -> None:
    """Writes a whole file or nothing. Raises `OutputError`."""
    with atomic_path(path) as temporary:
        temporary.write_bytes(data)


class OutputFolder:
    """A folder of results that are all written before the first is moved to where it belongs.

    `path` is a temporary folder while the body runs. At the end an absent target appears by one rename; in one that
    exists, files are replaced one by one, and files of other names stay. On any exception, Ctrl-C too, the temporary
    folder is removed and the target stays as it was. Raises `OutputError` where the target cannot be written or the
    disk is full.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as where:
    ...     with OutputFolder(Path(where) / "out") as folder:
    ...         _ = (folder.path / "report.json").write_text("{}")
    ...     (Path(where) / "out" / "report.json").read_text()
    '{}'
    """

    def __init__(self, target: Path) -> None:
        self.target = Path(target)
        # Inside a target that exists: only there is the file system, and the right to write, certain to be the same.
        parent = self.target if self.target.is_dir() else self.target.parent
        self.path = parent / f".{self.target.name or 'out'}.{secrets.token_hex(4)}.part"
        self._made: list[Path] = []

    def __enter__(self) -> "OutputFolder":
        try:
            if self.target.exists() and not self.target.is_dir():
                raise NotADirectoryError(errno.ENOTDIR, "it is a file, not a folder", str(self.target))
            self._made = _missing_parents(self.path.parent)
            self.path.mkdir(parents=True)
        except OSError as error:
            self._remove()
            raise self._failure(error) from error
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: object) -> None:
        try:
            if error is None:
                self._move()
                self._made = []
            elif isinstance(error, OSError) and self._is_ours(error):
                raise self._failure(error) from error
        except OSError as problem:
            raise self._failure(problem) from problem
        finally:
            self._remove()

    def _move(self) -> None:
        files = sorted(file for file in self.path.rglob("*") if file.is_file())
        for file in files:
            _check_target(self.target / file.relative_to(self.path))
            _sync(file)
        if not self.target.exists():
            os.rename(self.path, self.target)
        else:
            for file in files:
                place = self.target / file.relative_to(self.path)
                place.parent.mkdir(parents=True, exist_ok=True)
                os.replace(file, place)
        _sync(self.target)

    def _remove(self) -> None:
        shutil.rmtree(self.path, ignore_errors=True)
        for folder in self._made:
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()

    def _is_ours(self, error: OSError) -> bool:
        name = os.fspath(error.filename) if isinstance(error.filename, str | os.PathLike) else ""
        return error.errno in DISK_ERRORS or name.startswith(str(self.path))

    def _failure(self, error: OSError) -> OutputError:
        return OutputError(f"{self.target} could not be written: {_reason(error)}; nothing was changed.")


def _check_target(path: Path) -> None:
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, "a folder of that name exists", str(path))


def _missing_parents(folder: Path) -> list[Path]:
    """The folders that are still to be made, innermost first."""
    return [path for path in (folder, *folder.parents) if not path.exists()]


def _sync(path: Path) -> None:
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower()
