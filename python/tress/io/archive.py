"""What can be wrong with an .npz archive."""

import struct
import tokenize
import zipfile
import zlib
from pathlib import Path
from typing import IO, Final

MAX_BYTES: Final = 4 * 2**30

DAMAGE: Final = (
    ValueError,
    TypeError,
    KeyError,
    AttributeError,
    ImportError,
    EOFError,
    OSError,
    OverflowError,
    MemoryError,
    RuntimeError,
    SyntaxError,
    tokenize.TokenError,
    struct.error,
    zlib.error,
    zipfile.BadZipFile,
)
"""Everything that NumPy and zipfile raise on damaged archives."""


def check_size(archive: Path | IO[bytes]) -> None:
    """Raises `ValueError` for a packed archive of more than 4 GiB, before memory is asked for."""
    with zipfile.ZipFile(archive) as members:
        size = sum(member.file_size for member in members.infolist())
    if size > MAX_BYTES:
        raise ValueError(f"it claims {size / 2**30:.0f} GiB; at most {MAX_BYTES / 2**30:.0f} are read")
