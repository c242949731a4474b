"""Grouping strips."""

from collections.abc import Iterable
from dataclasses import replace

from tress.base.errors import InputError
from tress.edit.selection import refuse_locked
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.group import Group
from tress.model.record import Record
from tress.model.strip import Strip


def group(document: Document, *, names: Iterable[str], into: str, parent: str = "") -> Diff:
    """Puts strips and groups into the group `into`, which is made within `parent` where it is absent.

    Raises `InputError` where a name is neither a strip nor a group, `into` is another record, a group would lie within
    itself, or anything concerned is locked.
    """
    wanted = sorted(set(names))
    target = document.records.get(into)
    if target is not None and not isinstance(target, Group):
        raise InputError(f"Record {into!r} is a {type(target).__name__}; a group was expected.")
    pairs: dict[str, tuple[Record, Record]] = {}
    for name in wanted:
        before = document.records.get(name)
        if isinstance(before, Strip):
            after: Record = replace(before, group=into)
        elif isinstance(before, Group):
            after = replace(before, parent=into)
        else:
            found = "absent" if before is None else f"a {type(before).__name__}"
            raise InputError(f"Record {name!r} is {found}; a strip or a group was expected.")
        if before != after:
            pairs[name] = (before, after)
    refuse_locked(document, [*wanted, *([into] if target else [parent] if parent in document.records else [])])
    added = {} if target else {into: Group(parent=parent)}
    changed = {name: after for name, (_, after) in pairs.items()}
    Document({**document.records, **changed, **added})  # refuses groups within themselves
    return Diff(added=added, updated=pairs)
