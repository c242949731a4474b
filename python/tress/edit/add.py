"""Adding records."""

from collections.abc import Mapping

from tress.base.errors import InputError
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.record import Record


def add(document: Document, *, records: Mapping[str, Record]) -> Diff:
    """Adds records by name. Raises `InputError` where a name is taken, or a record names one that is not there."""
    taken = sorted(set(records) & set(document.records))
    if taken:
        raise InputError(f"Record {taken[0]!r} is there already; another name was expected.")
    Document({**document.records, **records})
    return Diff(added=records)
