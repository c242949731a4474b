"""Dissolving groups."""

from collections.abc import Iterable
from dataclasses import replace

from tress.base.errors import InputError
from tress.edit.fresh_names import FreshNames
from tress.edit.selection import refuse_locked
from tress.model.diff import Diff, squash
from tress.model.diff import apply as applied
from tress.model.document import Document
from tress.model.group import Group
from tress.model.keyframes import Keyframes
from tress.model.record import Record
from tress.model.strip import Strip


def ungroup(document: Document, *, names: Iterable[str]) -> Diff:
    """Removes groups; what was in them lies where they lay, and each member keeps the group's motion as its own.

    Raises `InputError` where a name is no group, or anything concerned is locked.
    """
    result, state = Diff(), document
    for name in sorted(set(names)):
        step = _dissolved(state, name)
        result, state = squash(result, step), applied(step, state)
    return result


def _dissolved(document: Document, name: str) -> Diff:
    old = document.records.get(name)
    if not isinstance(old, Group):
        found = "absent" if old is None else f"a {type(old).__name__}"
        raise InputError(f"Record {name!r} is {found}; a group was expected.")
    strips = {key: item for key, item in document.of_type(Strip).items() if item.group == name}
    groups = {key: item for key, item in document.of_type(Group).items() if item.parent == name}
    refuse_locked(document, [name, *strips, *groups])
    motions = {key: item for key, item in document.of_type(Keyframes).items() if item.target == name}
    fresh = FreshNames(document)
    copies = {
        fresh.next(key): replace(motion, target=member)
        for key, motion in motions.items()
        for member in sorted([*strips, *groups])
    }
    updated: dict[str, tuple[Record, Record]] = {
        key: (item, replace(item, group=old.parent)) for key, item in strips.items()
    }
    updated |= {key: (item, replace(item, parent=old.parent)) for key, item in groups.items()}
    return Diff(added=copies, updated=updated, removed={name: old, **motions})
