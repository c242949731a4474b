"""What a file format is to the rest of Tress."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from tress.model.document import Document

# What a round trip can bring back, from the least to the most.
STRANDS, COLOR, ALPHA, RADIUS, HEAD, CAMERA, DOCUMENT = (
    "strands",
    "color",
    "alpha",
    "radius",
    "head",
    "camera",
    "document",
)


def no_companions(_path: Path) -> list[Path]:
    """What most formats have beside their file: nothing."""
    return []


@dataclass(frozen=True)
class Format:
    """A format: its name, its suffixes with the dot, how it is written, and read where that is possible.

    `keeps` names what comes back exactly when a file is written and read: of `STRANDS` (points and offsets), `COLOR`,
    `ALPHA`, `RADIUS`, `HEAD` (positions and triangles), `CAMERA` and `DOCUMENT` (everything); `nearly` what comes back
    within `tolerance`. `write` raises `OutputError`, and `InputError` where the format cannot hold the document; `read`
    raises `FormatError`. Writing is deterministic, and the file appears whole or not at all. `companions` finds the
    files that were written beside a file for it, now or earlier. `strands_alone`: it holds no meshes and no strips, and
    refuses documents without strands.
    """

    name: str
    suffixes: tuple[str, ...]
    write: Callable[[Document, Path], None]
    read: Callable[[Path], Document] | None = None
    keeps: frozenset[str] = frozenset()
    nearly: frozenset[str] = frozenset()
    tolerance: float = 0.0
    companions: Callable[[Path], list[Path]] = no_companions
    strands_alone: bool = False
