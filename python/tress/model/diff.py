"""The one notion of change: what was added, updated and removed.

Methods and edits return a `Diff`, undo is its reverse, a drag squashes many into one. A diff carries the records before
and after, so that it can be reversed without the document and can see that it does not fit one.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from tress.base.errors import InputError
from tress.model.document import Document
from tress.model.frozen_map import FrozenMap
from tress.model.record import Record


class ConflictError(InputError):
    """A diff does not fit the document, or the diff before it."""


@dataclass(frozen=True)
class Diff:
    """Records added, updated (before, after) and removed, by identifier; an identifier stands in one of the three.

    Raises `InputError` where an identifier stands in several.
    """

    added: Mapping[str, Record] = field(default_factory=dict)
    updated: Mapping[str, tuple[Record, Record]] = field(default_factory=dict)
    removed: Mapping[str, Record] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("added", "updated", "removed"):
            object.__setattr__(self, name, FrozenMap(getattr(self, name)))
        twice = (set(self.added) & set(self.updated)) | (set(self.removed) & (set(self.added) | set(self.updated)))
        if twice:
            raise InputError(f"Record {min(twice)!r} stands in several parts of one diff.")

    __hash__ = None  # type: ignore[assignment]

    @property
    def is_empty(self) -> bool:
        """Whether the diff changes nothing."""
        return not (self.added or self.updated or self.removed)


def apply(diff: Diff, document: Document) -> Document:
    """The document after the change.

    Raises `ConflictError` where the document is not what the diff was made for: a record to add is there, one to update
    or remove is absent or differs from the record before.

    >>> from tress.model.camera import Camera
    >>> camera = Camera(xy_from_world=[[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]], width=1, height=1)
    >>> added = Diff(added={"photo": camera})
    >>> apply(reverse(added), apply(added, Document())) == Document()
    True
    """
    records = dict(document.records)
    for name, (before, after) in _changes(diff).items():
        _expect(records.get(name), before, name)
        if after is None:
            del records[name]
        else:
            records[name] = after
    return Document(records)


def reverse(diff: Diff) -> Diff:
    """The diff that takes the change back."""
    swapped = {name: (after, before) for name, (before, after) in diff.updated.items()}
    return Diff(added=diff.removed, updated=swapped, removed=diff.added)


def squash(first: Diff, second: Diff) -> Diff:
    """One diff for two in a row; what cancels out is left out.

    Raises `ConflictError` where `second` does not begin where `first` ends.
    """
    changes = dict(_changes(first))
    for name, (before, after) in _changes(second).items():
        origin, middle = changes.get(name, (before, before))
        _expect(middle, before, name)
        changes[name] = (origin, after)
    return _diff_of(changes)


def difference(before: Document, after: Document) -> Diff:
    """The diff that makes `after` of `before`."""
    every = set(before.records) | set(after.records)
    return _diff_of({name: (before.records.get(name), after.records.get(name)) for name in every})


Change = tuple[Record | None, Record | None]


def _changes(diff: Diff) -> dict[str, Change]:
    added: dict[str, Change] = {name: (None, record) for name, record in diff.added.items()}
    return added | dict(diff.updated) | {name: (record, None) for name, record in diff.removed.items()}


def _diff_of(changes: Mapping[str, Change]) -> Diff:
    added = {name: after for name, (before, after) in changes.items() if before is None and after is not None}
    removed = {name: before for name, (before, after) in changes.items() if after is None and before is not None}
    updated = {
        name: (before, after)
        for name, (before, after) in changes.items()
        if before is not None and after is not None and before is not after and before != after
    }
    return Diff(added=added, updated=updated, removed=removed)


def _expect(found: Record | None, expected: Record | None, name: str) -> None:
    if found is expected:
        return
    if expected is None:
        raise ConflictError(f"Record {name!r} is to be added, but it is there already.")
    if found is None:
        raise ConflictError(f"Record {name!r} is to be changed, but it is absent.")
    if found != expected:
        raise ConflictError(f"Record {name!r} is to be changed, but it differs from what the change was made for.")
