"""Hiding: what is hidden is not shown, and not written as geometry."""

from collections.abc import Iterable

from tress.edit.flags import with_flag
from tress.edit.selection import refuse_locked
from tress.model.diff import Diff
from tress.model.document import Document


def hide(document: Document, *, names: Iterable[str], hidden: bool = True) -> Diff:
    """Hides or shows strips and groups; a hidden group hides all within it.

    Raises `InputError` where a name is neither a strip nor a group, or is locked.
    """
    wanted = sorted(set(names))
    diff = with_flag(document, wanted, "hidden", hidden)
    refuse_locked(document, wanted)
    return diff
