"""Removing records."""

from collections.abc import Iterable

from tress.base.errors import InputError
from tress.edit.selection import refuse_locked
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.group import Group, lineage
from tress.model.keyframes import Keyframes
from tress.model.record import Record
from tress.model.strip import Strip


def delete(document: Document, *, names: Iterable[str]) -> Diff:
    """Removes the named records; with a group all that lies in it, and with strips and groups their keyframes.

    Raises `InputError` where one is absent, locked, or needed by a record that stays (a head by the strips on it).

    >>> delete(Document(), names=[]).is_empty
    True
    """
    wanted = set(names)
    absent = sorted(name for name in wanted if name not in document.records)
    if absent:
        raise InputError(f"There is no record {absent[0]!r} to delete.")
    gone = wanted | _within(document, wanted)
    refuse_locked(document, sorted(gone))
    gone |= {name for name, motion in document.of_type(Keyframes).items() if motion.target in gone}
    for name, record in document.records.items():
        needed = sorted(_needed(record) & gone)
        if name not in gone and needed:
            raise InputError(f"Record {needed[0]!r} is needed by {name!r}; delete or change that one too.")
    return Diff(removed={name: document.records[name] for name in gone})


def _within(document: Document, names: set[str]) -> set[str]:
    """Groups and strips inside the groups among `names`."""
    groups = {name for name in document.of_type(Group) if names & set(lineage(document, name))}
    return groups | {name for name, strip in document.of_type(Strip).items() if strip.group in groups}


def _needed(record: Record) -> set[str]:
    if not isinstance(record, Strip):
        return set()
    return {record.atlas, record.root.surface if record.root else ""} - {""}
