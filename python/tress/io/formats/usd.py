"""Documents as USD: the format that keeps everything.

Strands are `UsdGeomBasisCurves`, meshes `UsdGeomMesh` with their picture in a folder `textures` beside the file,
parameters metadata. Opening and saving again loses nothing, to the bit.
"""

from pathlib import Path

from tress import __version__
from tress.base.errors import FormatError, InputError
from tress.io.format import DOCUMENT, Format
from tress.io.usd.mapping import prim_of, record_of
from tress.io.usd.stage import SUFFIXES, read_stage, write_stage
from tress.model.document import Document

LAYOUT = 1  # of the prims; raised when a reader of the former could misread them


def save_document(document: Document, path: Path) -> None:
    """Writes a document as `.usdc`, `.usda` or `.usd`; a crash leaves the old file.

    Raises `OutputError` where it cannot be written, `InputError` for another suffix.
    """
    if path.suffix not in SUFFIXES:
        raise InputError(f"{path.name} has suffix {path.suffix!r}; one of {', '.join(SUFFIXES)} was expected.")
    prims = [prim_of(name, record) for name, record in document.records.items()]
    write_stage(prims, path, data={"layout": LAYOUT, "version": __version__})


def open_document(path: Path) -> Document:
    """The document of a file written by `save_document`. Raises `FormatError`."""
    prims, data = read_stage(path)
    if data.get("layout") != LAYOUT:
        raise FormatError(f"{path} has layout {data.get('layout')!r}; this version reads layout {LAYOUT}.")
    try:
        return Document({prim.name: record_of(prim) for prim in prims})
    except FormatError:
        raise
    except InputError as error:
        raise FormatError(f"{path} is damaged: {error}") from error


FORMAT = Format("usd", SUFFIXES, save_document, open_document, keeps=frozenset({DOCUMENT}))
