"""Strands as PLY, binary little-endian: points, and edges along the strands.

Each vertex has x, y, z (metres, Y up), red, green, blue (8-bit sRGB, what viewers expect), alpha, radius (metres) as
far as the strands have them, and `strand`, the number of its strand. Meshes are left out.
"""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tress.base.color import linear_to_srgb8, srgb_to_linear
from tress.base.errors import FormatError, InputError
from tress.io.atomic import write_bytes
from tress.io.file_bytes import read_bytes
from tress.io.format import ALPHA, COLOR, RADIUS, STRANDS, Format
from tress.io.joined import strands_alone
from tress.model.document import Document
from tress.model.strands import Strands

Array = np.ndarray[Any, Any]

TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "<i2",
    "ushort": "<u2",
    "int": "<i4",
    "uint": "<u4",
    "float": "<f4",
    "double": "<f8",
}
TYPES |= {
    "int8": "i1",
    "uint8": "u1",
    "int16": "<i2",
    "uint16": "<u2",
    "int32": "<i4",
    "uint32": "<u4",
    "float32": "<f4",
    "float64": "<f8",
}
NAMES = {"f4": "float", "u1": "uchar", "i4": "int"}
RGB = ("red", "green", "blue")
MAX_HEADER = 65_536


def encode_ply(strands: Strands) -> bytes:
    """The file's bytes; the same strands give the same bytes."""
    vertices = _table(_vertex_columns(strands))
    inner = np.ones(len(strands.points), bool)
    inner[strands.offsets[1:] - 1] = False
    first = np.flatnonzero(inner).astype(np.int32)
    edges = _table({"vertex1": first, "vertex2": first + np.int32(1)})
    header = [
        "ply",
        "format binary_little_endian 1.0",
        "comment Tress: strands root to tip; metres, Y up; sRGB",
        *_element("vertex", vertices),
        *_element("edge", edges),
        "end_header\n",
    ]
    return "\n".join(header).encode() + vertices.tobytes() + edges.tobytes()


def decode_ply(data: bytes) -> Strands:
    """The strands of a file's bytes: consecutive vertices of one `strand` number.

    Raises `FormatError` where the bytes are not a whole binary little-endian PLY file with such vertices.
    """
    elements, start = _header(data)
    tables = {}
    for element in elements:
        end = start + element.count * element.dtype.itemsize
        if end > len(data):
            raise FormatError(f"The PLY file ends within its {element.name} elements.")
        tables[element.name] = np.frombuffer(data, element.dtype, element.count, start)
        start = end
    vertices = tables.get("vertex")
    if vertices is None or not {"x", "y", "z", "strand"} <= set(vertices.dtype.names or ()):
        raise FormatError("The PLY file has no vertices with x, y, z and strand.")
    try:
        return _strands(vertices)
    except InputError as error:
        raise FormatError(f"The PLY file is damaged: {error}") from error


def write_ply(document: Document, path: Path) -> None:
    """Writes all strands of a document. Raises `InputError` where it has none."""
    write_bytes(path, encode_ply(strands_alone(document, form=".ply")))


def read_ply(path: Path) -> Document:
    """A document with the strands of a file as record `hair`."""
    return Document({"hair": decode_ply(read_bytes(path))})


FORMAT = Format(
    "ply",
    (".ply",),
    write_ply,
    read_ply,
    keeps=frozenset({STRANDS, RADIUS}),
    nearly=frozenset({COLOR, ALPHA}),
    tolerance=0.005,
    strands_alone=True,
)


@dataclass(frozen=True)
class _Element:
    name: str
    count: int
    dtype: np.dtype[Any]


def _vertex_columns(strands: Strands) -> dict[str, Array]:
    columns = dict(zip("xyz", strands.points.T, strict=True))
    if (color := strands.point_attributes.get("color")) is not None:
        columns |= dict(zip(RGB, linear_to_srgb8(color).T, strict=True))
    if (alpha := strands.point_attributes.get("alpha")) is not None:
        columns["alpha"] = (np.clip(alpha, 0, 1) * 255 + 0.5).astype(np.uint8)
    if (radius := strands.point_attributes.get("radius")) is not None:
        columns["radius"] = radius
    columns["strand"] = np.repeat(np.arange(strands.count, dtype=np.int32), strands.lengths)
    return columns


def _table(columns: dict[str, Array]) -> Array:
    rows = len(next(iter(columns.values())))
    table = np.empty(rows, [(name, values.dtype.newbyteorder("<")) for name, values in columns.items()])
    for name, values in columns.items():
        table[name] = values
    return table


def _element(name: str, table: Array) -> list[str]:
    columns = table.dtype.fields or {}
    return [f"element {name} {len(table)}"] + [
        f"property {NAMES[dtype.str[1:]]} {column}" for column, (dtype, *_) in columns.items()
    ]


def _header(data: bytes) -> tuple[list[_Element], int]:
    end = re.search(rb"\nend_header\r?\n", data[:MAX_HEADER])
    if not data.startswith(b"ply") or end is None:
        raise FormatError("The file has no PLY header.")
    words = [line.split() for line in data[: end.start()].decode("ascii", "replace").splitlines()[1:]]
    if ["format", "binary_little_endian", "1.0"] not in words:
        raise FormatError("The PLY file is not binary little-endian; that was expected.")
    elements: list[tuple[str, int, list[tuple[str, str]]]] = []
    for line in words:
        if line[:1] == ["element"]:
            elements.append(_element_line(line))
        elif line[:1] == ["property"]:
            _add_property(elements, line)
    try:
        return [_Element(name, count, np.dtype(columns)) for name, count, columns in elements], end.end()
    except ValueError as error:
        raise FormatError("The PLY header names a property twice.") from error


def _element_line(line: list[str]) -> tuple[str, int, list[tuple[str, str]]]:
    if len(line) != 3 or not line[2].isascii() or not line[2].isdigit() or len(line[2]) > 12:
        raise FormatError(f"The PLY header has a wrong line: {' '.join(line)[:80]!r}.")
    return line[1], int(line[2]), []


def _add_property(elements: list[tuple[str, int, list[tuple[str, str]]]], line: list[str]) -> None:
    if not elements or len(line) != 3 or line[1] not in TYPES:
        raise FormatError(f"The PLY header has a property that strands do not have: {' '.join(line)[:80]!r}.")
    elements[-1][2].append((line[2], TYPES[line[1]]))


def _strands(vertices: Array) -> Strands:
    columns = set(vertices.dtype.names or ())
    attributes: dict[str, Array] = {}
    if set(RGB) <= columns and vertices["red"].dtype == np.uint8:
        attributes["color"] = srgb_to_linear(np.stack([vertices[name] for name in RGB], axis=1))
    if "alpha" in columns and vertices["alpha"].dtype == np.uint8:
        attributes["alpha"] = vertices["alpha"] / np.float32(255)
    if "radius" in columns:
        attributes["radius"] = vertices["radius"]
    ends = np.flatnonzero(np.diff(vertices["strand"])) + 1
    return Strands(
        points=np.stack([vertices[name] for name in "xyz"], axis=1),
        offsets=np.concatenate([[0], ends, [len(vertices)]])[: None if len(vertices) else 1].astype(np.int64),
        point_attributes=attributes,
    )
