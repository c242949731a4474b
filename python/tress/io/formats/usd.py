"""Documents as USD: the format that keeps everything.

Strands are `UsdGeomBasisCurves`, meshes `UsdGeomMesh` with their picture in a folder `textures` beside the file,
parameters metadata. Opening and saving again loses nothing, to the bit. A fingerprint of the records is metadata too.
"""

import warnings
from dataclasses import replace
from pathlib import Path

from tress import __version__
from tress.base.errors import ChangedFileWarning, FormatError, InputError
from tress.io.apart import read_apart
from tress.io.format import DOCUMENT, Format
from tress.io.usd.content import content_of
from tress.io.usd.foreign import foreign_document
from tress.io.usd.mapping import prim_of, record_of
from tress.io.usd.prim import Prim
from tress.io.usd.shown import shown_prims
from tress.io.usd.stage import SUFFIXES, pictures_of, read_stage, write_stage, written_by_tress
from tress.model.document import Document

LAYOUT = 1  # of the prims; raised when a reader of the former could misread them


def save_document(document: Document, path: Path) -> None:
    """Writes a document as `.usdc`, `.usda` or `.usd`; a crash leaves the old file.

    Raises `OutputError` where it cannot be written, `InputError` for another suffix.
    """
    if path.suffix not in SUFFIXES:
        raise InputError(f"{path.name} has suffix {path.suffix!r}; one of {', '.join(SUFFIXES)} was expected.")
    shown = shown_prims(document)
    prims = [_with(prim_of(name, record), shown.get(name, ())) for name, record in document.records.items()]
    write_stage(prims, path, data={"layout": LAYOUT, "version": __version__, "content": content_of(document)})


def _with(prim: Prim, shown: tuple[Prim, ...]) -> Prim:
    """The prim of a record with what there is to see of it in its document."""
    return replace(prim, children=prim.children + shown)


def open_document(path: Path) -> Document:
    """The document of a file written by `save_document`, or the NURBS patches of another program's file as strips.

    Warns with `ChangedFileWarning` where the records are not those that were written: the file was damaged, or another
    program edited it. Raises `FormatError`, also for files that make OpenUSD crash, take all memory or never end: a
    process apart reads.
    """
    document, changed = read_apart(path, _document)
    if changed:
        warnings.warn(
            f"{path} was changed after Tress wrote it: by another program, or by damage.", ChangedFileWarning, 2
        )
    return document


def _document(path: Path) -> tuple[Document, bool]:
    """The document, and whether it is another than was written."""
    if not written_by_tress(path):
        return foreign_document(path), False
    prims, data = read_stage(path)
    if data.get("layout") != LAYOUT:
        raise FormatError(f"{path} has layout {data.get('layout')!r}; this version reads layout {LAYOUT}.")
    try:
        document = Document({prim.name: record_of(prim) for prim in prims})
        return document, "content" in data and data["content"] != content_of(document)
    except FormatError:
        raise
    except InputError as error:
        raise FormatError(f"{path} is damaged: {error}") from error


FORMAT = Format("usd", SUFFIXES, save_document, open_document, keeps=frozenset({DOCUMENT}), companions=pictures_of)
