"""Covering strips with pictures of strands."""

from collections.abc import Iterable
from dataclasses import replace

from tress.base.errors import InputError
from tress.edit.selection import editable_strips
from tress.model.atlas import Atlas
from tress.model.diff import Diff
from tress.model.document import Document


def cover(document: Document, *, names: Iterable[str], atlas: str, regions: Iterable[int] = (0,)) -> Diff:
    """Covers strips with the regions of an atlas, in turn; `atlas` "" uncovers them.

    Raises `InputError` where the atlas or a region is absent, or a strip is locked.
    """
    chosen = list(regions)
    record = document.records.get(atlas)
    if atlas and not isinstance(record, Atlas):
        raise InputError(f"Record {atlas!r} is {'absent' if record is None else 'no atlas'}; an atlas was expected.")
    count = len(record.regions) if isinstance(record, Atlas) else 1
    if not chosen or not all(0 <= region < count for region in chosen):
        raise InputError(f"Regions {chosen}: numbers from 0 to {count - 1} were expected.")
    strips = editable_strips(document, names)
    pairs = {
        name: (before, replace(before, atlas=atlas, region=chosen[index % len(chosen)]))
        for index, (name, before) in enumerate(strips.items())
    }
    return Diff(updated={name: pair for name, pair in pairs.items() if pair[0] != pair[1]})
