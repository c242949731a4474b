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
from tress.io.number_text import batches, decimals, flagged, shares, text_of_rows, whole_numbers
from tress.io.obj_lines import Run, runs
from tress.model.document import Document
from tress.model.evaluate import Scene, evaluate
from tress.model.mesh import Mesh
from tress.model.record import Record
from tress.model.strands import Strands

Array = np.ndarray[Any, Any]


def encode_obj(scene: Scene) -> bytes:
    """The file's bytes, one object for each of the strands and meshes; the same scene gives the same bytes."""
    parts = [b"# Tress: metres, Y up; strands root to tip\n"]
    vertices, coordinates = 1, 1  # OBJ counts from 1, over all objects
    for name, mesh in scene.meshes.items():
        parts += [f"o {name}\n".encode(), *_mesh_text(mesh, vertices, coordinates)]
        vertices += len(mesh.positions)
        coordinates += 0 if mesh.corner_uv is None else mesh.corner_uv.size // 2
    for name, strands in scene.strands.items():
        parts += [f"o {name}\n".encode(), *_strands_text(strands, vertices)]
        vertices += len(strands.points)
    return b"".join(parts)


def decode_obj(data: bytes) -> dict[str, Record]:
    """The strands and meshes of a file's bytes by the name of their object; polygons become fans of triangles.

    Raises `FormatError` where a line cannot be read.
    """
    file = _File()
    for run in runs(data):
        if not file.take_run(run):
            _take_lines(file, run)
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


def _mesh_text(mesh: Mesh, first_vertex: int, first_coordinate: int) -> Iterator[bytes]:
    yield from _vertices(mesh.positions)
    corners = mesh.triangles.astype(np.int64) + first_vertex
    if mesh.corner_uv is None:
        yield from (text_of_rows("f", *_columns(corners[rows]), "\n") for rows in batches(len(corners)))
        return
    uv = mesh.corner_uv.reshape(-1, 2)
    yield from (text_of_rows("vt", decimals(uv[rows]), "\n") for rows in batches(len(uv)))
    places = np.arange(corners.size).reshape(-1, 3) + first_coordinate
    for rows in batches(len(corners)):
        yield text_of_rows("f", *_columns(corners[rows], places[rows]), "\n")


def _columns(corners: Array, places: Array | None = None) -> Iterator[Array | str]:
    """The corners of triangles, each with its texture coordinate where there is one."""
    for corner in range(3):
        yield from (" ", whole_numbers(corners[:, corner]))
        if places is not None:
            yield from ("/", whole_numbers(places[:, corner]))


def _vertices(points: Array, color: Array | None = None) -> Iterator[bytes]:
    for rows in batches(len(points)):
        shade = () if color is None else (shares(linear_to_srgb(color[rows])),)
        yield text_of_rows("v", decimals(points[rows]), *shade, "\n")


def _strands_text(strands: Strands, first_vertex: int) -> Iterator[bytes]:
    yield from _vertices(strands.points, strands.point_attributes.get("color"))
    first, last = np.zeros((2, len(strands.points)), bool)
    first[strands.offsets[:-1]] = True
    last[strands.offsets[1:] - 1] = True
    for rows in batches(len(strands.points)):
        numbers = whole_numbers(np.arange(rows.start, rows.stop) + first_vertex)
        yield text_of_rows(flagged(first[rows], "l"), " ", numbers, flagged(last[rows], "\n"))


def _take_lines(file: "_File", run: Run) -> None:
    """Reads a run line by line. Raises `FormatError` that names the line."""
    for number, line in enumerate(run.text.decode("utf-8", "replace").split("\n"), run.first_line):
        try:
            file.take(line.split())
        except (ValueError, IndexError, OverflowError) as error:
            raise FormatError(f"Line {number} of the OBJ file cannot be read: {line[:60]!r}.") from error


@dataclass
class _Object:
    name: str
    first_vertex: int
    line_vertices: list[Array] = field(default_factory=list)
    line_lengths: list[Array] = field(default_factory=list)
    triangles: list[list[int]] = field(default_factory=list)
    corners: list[list[int]] = field(default_factory=list)
    end_vertex: int = 0


class _File:
    """What was read of a file so far. Vertices are rows of x, y, z, red, green, blue; NaN where there is no colour."""

    def __init__(self) -> None:
        self.vertices: list[Array] = []
        self.vertex_count = 0
        self.coordinates: list[list[float]] = []
        self.objects = [_Object("object", 0)]

    def take_run(self, run: Run) -> bool:
        """Reads lines of one kind at once; False where they have to be read one by one, and nothing was taken."""
        found = run.numbers() if run.kind in ("v", "l") else None
        if found is None:
            return False
        values, counts = found
        if run.kind == "l":
            return self._take_polylines(values, counts)
        if counts.min() != counts.max() or counts[0] not in (3, 6):
            return False
        self._add_vertices(values.reshape(-1, counts[0]))
        return True

    def take(self, words: list[str]) -> None:
        """Reads one line."""
        match words:
            case ["v", *numbers]:
                values = [float(number) for number in numbers]
                if len(values) < 3:
                    raise ValueError("a vertex has three coordinates")
                self._add_vertices(np.array([values if len(values) == 6 else values[:3]]))
            case ["vt", u, v, *_]:
                self.coordinates.append([float(u), float(v)])
            case ["l", *corners]:
                line = [self._vertex(corner) for corner in corners]
                self._add_polylines(np.array(line, np.int64), np.array([len(line)]))
            case ["f", *corners]:
                self._take_face(corners)
            case ["o" | "g", *names]:
                self._end_object()
                self.objects.append(_Object("_".join(names) or "object", self.vertex_count))
            case _:
                pass

    def records(self) -> Iterator[tuple[str, Record]]:
        """The strands and meshes of the objects."""
        self._end_object()
        vertices = np.concatenate([np.zeros((0, 6)), *self.vertices])
        taken: set[str] = set()
        for part in self.objects:
            if part.line_lengths:
                yield _free_name(part.name, taken), self._strands(part, vertices)
            if part.triangles:
                yield _free_name(part.name, taken), self._mesh(part, vertices)

    def _add_vertices(self, rows: Array) -> None:
        """Takes (N, 3) positions or (N, 6) positions and colours."""
        padding = np.full((len(rows), 6 - rows.shape[1]), np.nan)
        self.vertices.append(np.hstack([rows, padding]))
        self.vertex_count += len(rows)

    def _take_polylines(self, numbers: Array, counts: Array) -> bool:
        usual = numbers.size and numbers.min() >= 1 and numbers.max() <= self.vertex_count
        if usual:
            self._add_polylines(numbers - 1, counts)
        return bool(usual)

    def _add_polylines(self, vertices: Array, counts: Array) -> None:
        self.objects[-1].line_vertices.append(vertices)
        self.objects[-1].line_lengths.append(counts)

    def _strands(self, part: _Object, vertices: Array) -> Strands:
        rows = vertices[np.concatenate(part.line_vertices)]
        colored = len(rows) > 0 and not np.isnan(rows[:, 3:]).all(axis=1).any()
        with np.errstate(all="ignore"):  # what is not a number is refused with the strands
            color = srgb_to_linear(rows[:, 3:])
        return Strands(
            points=rows[:, :3],
            offsets=np.cumsum(np.concatenate([[0], *part.line_lengths])),
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
        return _index(corner.split("/")[0], self.vertex_count)

    def _end_object(self) -> None:
        self.objects[-1].end_vertex = self.vertex_count


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
