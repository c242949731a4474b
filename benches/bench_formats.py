"""Time and size of every format: 50,000 strands of 40 points with all attributes, and a head with its picture."""

import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tress.io.format import Format
from tress.io.formats.registry import FORMATS
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.strands import Strands
from tress.model.texture import Texture


@dataclass(frozen=True)
class FormatTime:
    """Seconds to write and to read (None where the format is not read), and the file's size in megabytes."""

    name: str
    write_secs: float
    read_secs: float | None
    size_mb: float


def portrait(*, strands: int = 50_000, points: int = 40) -> Document:
    """A document of the size that a portrait gives."""
    random = np.random.default_rng(0)
    total = strands * points
    start = random.normal(size=(strands, 1, 3)) * 0.1
    path = start + np.linspace(0, 0.2, points)[None, :, None] * [0, -1, 0]
    hair = Strands(
        points=path.reshape(-1, 3),
        offsets=np.arange(strands + 1) * points,
        point_attributes={
            "color": random.random((total, 3)),
            "alpha": random.random(total),
            "radius": np.full(total, 4e-5),
        },
        strand_attributes={"root_barycentric": random.random((strands, 3)), "visible": random.random(strands) > 0.5},
    )
    triangles = random.integers(0, 4_433, (8_812, 3))
    head = Mesh(
        positions=random.random((4_433, 3)),
        triangles=triangles,
        corner_uv=random.random((4_433, 2))[triangles],
        texture=Texture(pixels=random.integers(0, 255, (128, 128, 3), np.uint8).repeat(8, 0).repeat(8, 1)),
    )
    camera = Camera(xy_from_world=[[3000, 0, 0, 500], [0, -3000, 0, 500], [0, 0, 0, 1]], width=1000, height=1000)
    return Document({"hair": hair, "head": Head(mesh=head, shape=[], expression=[]), "photo": camera})


def format_time(form: Format, document: Document) -> FormatTime:
    """Writes and reads a document once."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"hair{form.suffixes[0]}"
        start = time.perf_counter()
        form.write(document, path)
        written = time.perf_counter()
        if form.read is not None:
            form.read(path)
        read_secs = time.perf_counter() - written if form.read is not None else None
        return FormatTime(form.name, written - start, read_secs, path.stat().st_size / 1e6)


def format_times() -> list[FormatTime]:
    """One row per format."""
    document = portrait()
    return [format_time(form, document) for form in FORMATS]


def main() -> None:
    """Prints the table."""
    print(f"{'format':8}{'write s':>10}{'read s':>10}{'MB':>10}")
    for row in format_times():
        read = f"{row.read_secs:10.2f}" if row.read_secs is not None else f"{'-':>10}"
        print(f"{row.name:8}{row.write_secs:10.2f}{read}{row.size_mb:10.1f}")


if __name__ == "__main__":
    main()
