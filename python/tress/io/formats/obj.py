"""Strands as polylines and meshes as triangles, Wavefront OBJ.

Metres, Y up, as text that gives back the same float32. Points of strands carry their colour behind the coordinates
(sRGB, an extension that most programs read). Meshes have texture coordinates, but no material.
"""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tress.base.color import linear_to_srgb, srgb_to_linear
from tress.base.errors import FormatError, InputError
from tress.io.atomic import write_bytes
from tress.io.file_bytes import read_bytes
from tress.io.format import COLOR, HEAD, STRANDS, Format
from tress.model.document import Document
from tress.model.evaluate import Scene, evaluate
from tress.model.mesh import Mesh
from tress.model.record import Record
from tress.model.strands import Strands

Array = np.ndarray[Any, Any]


def encode_obj(scene: Scene) -> bytes:
    """The file's bytes, one object for each of the strands and meshes; the same scene gives the same bytes."""
    parts = ["# Tress: metres, Y up; strands root to tip\n"]
    vertices, coordinates = 1, 1  # OBJ counts from 1, over all objects
    for name, mesh in scene.meshes.items():
        parts += [f"o {name}\n", *_mesh_text(mesh, vertices, coordinates)]
        vertices += len(mesh.positions)
        coordinates += 0 if mesh.corner_uv is None else mesh.corner_uv.size // 2
    for name, strands in scene.strands.items():
        parts += [f"o {name}\n", *_strands_text(strands, vertices)]
        vertices += len(strands.points)
    return "".join(parts).encode()


def decode_obj(data: bytes) -> dict[str, Record]:
    """The strands and meshes of a file's bytes by the name of their object; polygons become fans of triangles.

    Raises `FormatError` where a line cannot be read.
    """
    file = _File()
    for number, line in enumerate(data.decode("utf-8", "replace").splitlines(), 1):
        try:
            file.take(line.split())
        except (ValueError, IndexError, OverflowError) as error:
            raise FormatError(f"Line {number} of the OBJ file cannot be read: {line[:60]!r}.") from error
    try:
        return dict(file.records())
    except (InputError, OverflowError) as error:
        raise FormatError(f"The OBJ file is damaged: {error}") from error


def write_obj(document: Document, path: Path) -> None:
    """Writes all strands and meshes of a document."""
    write_bytes(path, encode_obj(evaluate(document)))


def read_obj(path: Path) -> Document:
    """A document with the strands and meshes of a file."""
    return Document(decode_obj(read_bytes(path)))


FORMAT = Format(
    "obj",
    (".obj",),
    write_obj,
    read_obj,
    keeps=frozenset({STRANDS, HEAD}),
    nearly=frozenset({COLOR}),
    tolerance=0.0002,
)


def _rows(pattern: str, values: Array) -> str:
    """`pattern` once for every row; one formatting of everything is ten times faster than row by row."""
    return (pattern * len(values)) % tuple(values.reshape(-1).tolist())


def _mesh_text(mesh: Mesh, first_vertex: int, first_coordinate: int) -> Iterator[str]:
    yield _rows("v %.9g %.9g %.9g\n", mesh.positions)
    corners = mesh.triangles.astype(np.int64) + first_vertex
    if mesh.corner_uv is None:
        yield _rows("f %d %d %d\n", corners)
        return
    yield _rows("vt %.9g %.9g\n", mesh.corner_uv.reshape(-1, 2))
    uv = np.arange(corners.size).reshape(-1, 3) + first_coordinate
    yield _rows("f %d/%d %d/%d %d/%d\n", np.stack([corners, uv], axis=-1).reshape(-1, 6))


def _strands_text(strands: Strands, first_vertex: int) -> Iterator[str]:
    color = strands.point_attributes.get("color")
    if color is None:
        yield _rows("v %.9g %.9g %.9g\n", strands.points)
    else:
        yield _rows("v %.9g %.9g %.9g %.4f %.4f %.4f\n", np.hstack([strands.points, linear_to_srgb(color)]))
    numbers = list(map(str, range(first_vertex, first_vertex + len(strands.points))))
    bounds = strands.offsets.tolist()
    for start, end in itertools.pairwise(bounds):
        yield f"l {' '.join(numbers[start:end])}\n"


@dataclass
class _Object:
    name: str
    first_vertex: int
    lines: list[list[int]] = field(default_factory=list)
    triangles: list[list[int]] = field(default_factory=list)
    corners: list[list[int]] = field(default_factory=list)
    end_vertex: int = 0


class _File:
    """What was read of a file so far."""

    def __init__(self) -> None:
        self.vertices: list[list[float]] = []
        self.colored: list[bool] = []
        self.coordinates: list[list[float]] = []
        self.objects = [_Object("object", 0)]

    def take(self, words: list[str]) -> None:
        """Reads one line."""
        match words:
            case ["v", *numbers]:
                values = [float(number) for number in numbers]
                self.colored.append(len(values) == 6)
                self.vertices.append(values if len(values) == 6 else [*values[:3], 0.0, 0.0, 0.0])
                if len(values) < 3:
                    raise ValueError("a vertex has three coordinates")
            case ["vt", u, v, *_]:
                self.coordinates.append([float(u), float(v)])
            case ["l", *corners]:
                self.objects[-1].lines.append([self._vertex(corner) for corner in corners])
            case ["f", *corners]:
                self._take_face(corners)
            case ["o" | "g", *names]:
                self._end_object()
                self.objects.append(_Object("_".join(names) or "object", len(self.vertices)))
            case _:
                pass

    def records(self) -> Iterator[tuple[str, Record]]:
        """The strands and meshes of the objects."""
        self._end_object()
        vertices = np.array(self.vertices, np.float64).reshape(-1, 6)
        taken: set[str] = set()
        for part in self.objects:
            if part.lines:
                yield _free_name(part.name, taken), self._strands(part, vertices)
            if part.triangles:
                yield _free_name(part.name, taken), self._mesh(part, vertices)

    def _strands(self, part: _Object, vertices: Array) -> Strands:
        order = np.array([number for line in part.lines for number in line], np.int64)
        colored = order.size and np.array(self.colored)[order].all()
        with np.errstate(all="ignore"):  # what is not a number is refused with the strands
            color = srgb_to_linear(vertices[order, 3:])
        return Strands(
            points=vertices[order, :3],
            offsets=np.cumsum([0, *(len(line) for line in part.lines)]),
            point_attributes={"color": color} if colored else {},
        )

    def _mesh(self, part: _Object, vertices: Array) -> Mesh:
        triangles = np.array(part.triangles, np.int64)
        own = range(part.first_vertex, part.end_vertex)
        if triangles.min() >= own.start and triangles.max() < own.stop:
            used = np.arange(own.start, own.stop)
        else:
            used = np.unique(triangles)
        whole = len(part.corners) == len(part.triangles)
        coordinates = np.array(self.coordinates).reshape(-1, 2)
        return Mesh(
            positions=vertices[used, :3],
            triangles=np.searchsorted(used, triangles),
            corner_uv=coordinates[np.array(part.corners)] if whole else None,
        )

    def _take_face(self, corners: list[str]) -> None:
        part = self.objects[-1]
        numbers = [self._vertex(corner) for corner in corners]
        uv = [corner.split("/")[1] for corner in corners if corner.count("/") and corner.split("/")[1]]
        if len(numbers) < 3:
            raise ValueError("a face has three corners")
        part.triangles += [[numbers[0], a, b] for a, b in itertools.pairwise(numbers[1:])]
        if len(uv) == len(corners):
            places = [_index(number, len(self.coordinates)) for number in uv]
            part.corners += [[places[0], a, b] for a, b in itertools.pairwise(places[1:])]

    def _vertex(self, corner: str) -> int:
        return _index(corner.split("/")[0], len(self.vertices))

    def _end_object(self) -> None:
        self.objects[-1].end_vertex = len(self.vertices)


def _index(number: str, count: int) -> int:
    """The index from 0 of a number that counts from 1, or backwards from -1."""
    value = int(number)
    index = value - 1 if value > 0 else count + value
    if value == 0 or not 0 <= index < count:
        raise IndexError(f"{value} names none of {count}")
    return index


def _free_name(name: str, taken: set[str]) -> str:
    """A record identifier made of a name, other than those taken, which it joins."""
    plain = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in name) or "object"
    plain = plain if plain[0].isalpha() or plain[0] == "_" else f"_{plain}"
    result, number = plain, 2
    while result in taken:
        result, number = f"{plain}_{number}", number + 1
    taken.add(result)
    return result
