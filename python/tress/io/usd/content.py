"""What a document holds, in a word: written into its file, and compared when the file is opened."""

import dataclasses
from collections.abc import Mapping
from typing import Any

from tress.io.fingerprint import fingerprint
from tress.model.document import Document


def content_of(document: Document) -> str:
    """32 hexadecimal digits that stand for every bit of every record, in whatever order these are listed.

    Cost: the size of the document, about half a second a gigabyte.

    >>> content_of(Document()) == content_of(Document({}))
    True
    """
    return fingerprint(_ordered(document.records))


def _ordered(value: Any) -> Any:
    """The value with records as mappings and mappings by name, which files may list in another order."""
    if isinstance(value, Mapping):
        return {key: _ordered(value[key]) for key in sorted(value)}
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = {field.name: _ordered(getattr(value, field.name)) for field in dataclasses.fields(value)}
        return {"record": type(value).__name__, "fields": fields}
    return value
