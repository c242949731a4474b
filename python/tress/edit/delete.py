"""Removing records."""

from collections.abc import Iterable

from tress.base.errors import InputError
from tress.model.diff import Diff
from tress.model.document import Document


def delete(document: Document, *, names: Iterable[str]) -> Diff:
    """Removes the named records. Raises `InputError` where one is absent.

    >>> delete(Document(), names=[]).is_empty
    True
    """
    wanted = sorted(set(names))
    absent = [name for name in wanted if name not in document.records]
    if absent:
        raise InputError(f"There is no record {absent[0]!r} to delete.")
    return Diff(removed={name: document.records[name] for name in wanted})
