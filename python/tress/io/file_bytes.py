"""Files in, whole."""

from pathlib import Path

from tress.base.errors import FormatError


def read_bytes(path: Path) -> bytes:
    """The bytes of a file. Raises `FormatError` where there is none that can be read."""
    try:
        return path.read_bytes()
    except OSError as error:
        raise FormatError(f"{path} could not be read: {(error.strerror or str(error)).lower()}.") from error
