"""Files of other programs: their NURBS patches as strips."""

import re
from pathlib import Path

from tress.base.errors import FormatError
from tress.io.usd.patch import keyframes_of, strip_of
from tress.io.usd.stage import read_foreign
from tress.model.document import Document
from tress.model.record import Record


def foreign_document(path: Path) -> Document:
    """A document with the NURBS patches of a file as strips, named after their prims, and their time samples as
    keyframes; metres, Y up.

    Raises `FormatError` where there are none, or one cannot be a strip.
    """
    patches = read_foreign(path, type_name="NurbsPatch")
    if not patches:
        raise FormatError(f"{path} holds no document of Tress and no NURBS patches.")
    records: dict[str, Record] = {}
    for patch in patches:
        name = _free_name(patch.prim.name, records)
        records[name] = strip_of(patch.prim, head_from_prim=patch.world_from_prim)
        keyframes = keyframes_of(patch.prim, target=name, head_from_prim=patch.world_from_prim)
        if keyframes is not None:
            records[_free_name(f"{name}_keyframes", records)] = keyframes
    return Document(records)


def _free_name(name: str, taken: dict[str, Record]) -> str:
    """The name as an identifier of a document, numbered where it is taken."""
    stem = re.sub(r"\W", "_", name, flags=re.ASCII)
    stem = stem if stem.isidentifier() else f"_{stem}"
    number, result = 1, stem
    while result in taken:
        number += 1
        result = f"{stem}_{number}"
    return result
