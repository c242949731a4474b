"""Locking: what is locked refuses edits until it is unlocked."""

from collections.abc import Iterable

from tress.edit.flags import with_flag
from tress.model.diff import Diff
from tress.model.document import Document


def lock(document: Document, *, names: Iterable[str], locked: bool = True) -> Diff:
    """Locks or unlocks strips and groups; a locked group locks all within it.

    Raises `InputError` where a name is neither a strip nor a group.
    """
    return with_flag(document, names, "locked", locked)
