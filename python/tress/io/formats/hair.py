"""Cem Yuksel's `.hair` files, little-endian.

A header of 128 bytes, then u16 segments per strand (points less one), then f32 points, thickness, transparency and
colour as far as the header announces them. The format fixes neither unit nor axes: Tress writes metres, Y up, root to
tip, linear RGB, and thickness as diameter, says so in the header's text, and reads the numbers as they stand. Colour
space and thickness are conventions of ours too. Source: C. Yuksel, "HAIR file format",
http://www.cemyuksel.com/research/hairmodels.
"""

import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tress.base.errors import FormatError, InputError
from tress.io.atomic import write_bytes
from tress.io.file_bytes import read_bytes
from tress.io.format import ALPHA, COLOR, RADIUS, STRANDS, Format
from tress.io.joined import strands_alone
from tress.model.document import Document
from tress.model.strands import Strands

HEADER = struct.Struct("<4sIIIIff3f88s")
MAX_SEGMENTS = 65_535
SEGMENTS, POINTS, THICKNESS, TRANSPARENCY, COLORS = 1, 2, 4, 8, 16
INFO = b"Tress: metres, Y up, root to tip, linear RGB, thickness is diameter"

Array = np.ndarray[Any, Any]


def encode_hair(strands: Strands) -> bytes:
    """The file's bytes: points, and radius, alpha and colour where the strands have them.

    The same strands give the same bytes. Raises `InputError` for a strand of more than 65,536 points.
    """
    if strands.count and strands.lengths.max() > MAX_SEGMENTS + 1:
        raise InputError(f"A strand has {strands.lengths.max()} points; .hair holds at most {MAX_SEGMENTS + 1}.")
    radius, alpha, color = (strands.point_attributes.get(name) for name in ("radius", "alpha", "color"))
    blocks = {
        SEGMENTS: (strands.lengths - 1).astype("<u2"),
        POINTS: strands.points,
        THICKNESS: None if radius is None else radius * np.float32(2),
        TRANSPARENCY: None if alpha is None else np.float32(1) - alpha,
        COLORS: color,
    }
    bits = sum(bit for bit, values in blocks.items() if values is not None)
    header = HEADER.pack(b"HAIR", strands.count, len(strands.points), bits, 0, 0.0001, 0.0, 1.0, 1.0, 1.0, INFO)
    parts = [
        values.astype(values.dtype.newbyteorder("<")).tobytes() for values in blocks.values() if values is not None
    ]
    return b"".join([header, *parts])


def decode_hair(data: bytes) -> Strands:
    """The strands of a file's bytes, coordinates and colours as they stand; the header's defaults are left aside.

    Raises `FormatError` where the bytes are not a whole `.hair` file of strands with two points or more.
    """
    header = _header(data)
    arrays = _arrays(data, header)
    segments = arrays.get(SEGMENTS, np.full(header.strands, header.default_segments, np.int64)).astype(np.int64)
    if segments.size and segments.min() < 1:
        raise FormatError(f"Strand {int(np.argmin(segments))} of the .hair file has no segment.")
    if (segments + 1).sum() != header.points:
        raise FormatError(
            f"The .hair file announces {header.points} points, but its strands have {(segments + 1).sum()}."
        )
    try:
        return Strands(
            points=arrays[POINTS].reshape(-1, 3),
            offsets=np.concatenate([np.zeros(1, np.int64), np.cumsum(segments + 1)]),
            point_attributes=_attributes(arrays),
        )
    except InputError as error:
        raise FormatError(f"The .hair file is damaged: {error}") from error


def write_hair(document: Document, path: Path) -> None:
    """Writes all strands of a document. Raises `InputError` where it has none."""
    write_bytes(path, encode_hair(strands_alone(document, form=".hair")))


def read_hair(path: Path) -> Document:
    """A document with the strands of a file as record `hair`."""
    return Document({"hair": decode_hair(read_bytes(path))})


FORMAT = Format(
    "hair",
    (".hair",),
    write_hair,
    read_hair,
    keeps=frozenset({STRANDS, COLOR, RADIUS}),
    nearly=frozenset({ALPHA}),
    tolerance=2.0**-24,
    strands_alone=True,
)


@dataclass(frozen=True)
class _Header:
    strands: int
    points: int
    bits: int
    default_segments: int


def _header(data: bytes) -> _Header:
    if len(data) < HEADER.size:
        raise FormatError(f"The file has {len(data)} bytes; a .hair file has a header of {HEADER.size}.")
    magic, strands, points, bits, default_segments, *_ = HEADER.unpack_from(data)
    if magic != b"HAIR":
        raise FormatError(f"The file begins with {magic!r}; a .hair file begins with b'HAIR'.")
    if not bits & POINTS:
        raise FormatError("The .hair file holds no points.")
    return _Header(strands, points, bits, default_segments)


def _attributes(arrays: dict[int, Array]) -> dict[str, Array]:
    attributes = {}
    with np.errstate(invalid="ignore"):  # what is not a number is refused with the strands
        if THICKNESS in arrays:
            attributes["radius"] = arrays[THICKNESS] / np.float32(2)
        if TRANSPARENCY in arrays:
            attributes["alpha"] = np.float32(1) - arrays[TRANSPARENCY]
    if COLORS in arrays:
        attributes["color"] = arrays[COLORS].reshape(-1, 3)
    return attributes


def _arrays(data: bytes, header: _Header) -> dict[int, Array]:
    """The blocks that the header announces, by their bit. Sizes are checked before anything is allocated."""
    layout = {
        SEGMENTS: ("<u2", header.strands),
        POINTS: ("<f4", 3 * header.points),
        THICKNESS: ("<f4", header.points),
        TRANSPARENCY: ("<f4", header.points),
        COLORS: ("<f4", 3 * header.points),
    }
    present = {bit: block for bit, block in layout.items() if header.bits & bit}
    wanted = HEADER.size + sum(np.dtype(dtype).itemsize * count for dtype, count in present.values())
    if len(data) != wanted:
        raise FormatError(f"The .hair file has {len(data)} bytes; its header announces {wanted}.")
    if header.strands > header.points:
        raise FormatError(f"The .hair file announces {header.strands} strands of {header.points} points together.")
    arrays, start = {}, HEADER.size
    for bit, (dtype, count) in present.items():
        arrays[bit] = np.frombuffer(data, dtype, count, start)
        start += arrays[bit].nbytes
    return arrays
