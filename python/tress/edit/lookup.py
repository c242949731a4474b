"""Records by name, for edits that need one of a certain type."""

from tress.base.errors import InputError
from tress.model.document import Document
from tress.model.strands import Strands


def strands_named(document: Document, name: str) -> Strands:
    """The strands `name` of a document. Raises `InputError` where there are none."""
    record = document.records.get(name)
    if not isinstance(record, Strands):
        raise InputError(f"Record {name!r} is {_what(record)}; strands were expected.")
    return record


def _what(record: object) -> str:
    return "absent" if record is None else f"a {type(record).__name__}"
