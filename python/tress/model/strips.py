"""Which strips there are, which are seen and which may be changed: what groups mean for the strips within."""

from collections.abc import Iterable

from tress.base.errors import InputError
from tress.model.document import Document
from tress.model.group import Group, lineage
from tress.model.strip import Strip


def strip_names(document: Document, names: Iterable[str]) -> list[str]:
    """The strips that `names` stand for, in alphabetical order: strips, and all strips within groups.

    Raises `InputError` where a name is neither.
    """
    strips, wanted, groups = document.of_type(Strip), set(), set()
    for name in names:
        record = document.records.get(name)
        if isinstance(record, Strip):
            wanted.add(name)
        elif isinstance(record, Group):
            groups.add(name)
        else:
            found = "absent" if record is None else f"a {type(record).__name__}"
            raise InputError(f"Record {name!r} is {found}; a strip or a group was expected{groups_named(document)}.")
    if groups:
        within = {group for group in document.of_type(Group) if groups.intersection(lineage(document, group))}
        wanted |= {name for name, strip in strips.items() if strip.group in within}
    return sorted(wanted)


def strips_in(document: Document, group: str) -> dict[str, Strip]:
    """The strips directly in `group`, or in none for ""."""
    return {name: strip for name, strip in document.of_type(Strip).items() if strip.group == group}


def visible_strips(document: Document, *, group: str = "") -> list[str]:
    """The strips directly in `group` (or in none) that are not hidden; empty where the group is."""
    if any(_group(document, name).hidden for name in lineage(document, group)):
        return []
    return [name for name, strip in strips_in(document, group).items() if not strip.hidden]


def shown_strips(document: Document) -> list[str]:
    """All strips that neither are hidden nor lie in a group that is, in alphabetical order."""
    groups = {strip.group for strip in document.of_type(Strip).values()}
    return sorted(name for group in groups for name in visible_strips(document, group=group))


def locked_by(document: Document, name: str) -> str:
    """The strip or group that locks the strip or group `name`: itself, a group that it is in, or "" for none."""
    record = document.records[name]
    if isinstance(record, Strip | Group) and record.locked:
        return name
    outer = record.group if isinstance(record, Strip) else record.parent if isinstance(record, Group) else ""
    return next((group for group in lineage(document, outer) if _group(document, group).locked), "")


def _group(document: Document, name: str) -> Group:
    record = document.records[name]
    assert isinstance(record, Group)
    return record


def groups_named(document: Document) -> str:
    """The groups of a document as words for a message: ": its groups are a, b"; nothing where there are none."""
    groups = ", ".join(document.of_type(Group))
    return f": its groups are {groups}" if groups else ""
