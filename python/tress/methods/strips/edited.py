"""Edits in a row."""

from collections.abc import Callable
from typing import Any

from tress.model.diff import Diff, apply
from tress.model.document import Document


def edited(document: Document, edit: Callable[..., Diff], **arguments: Any) -> Document:
    """The document after an edit with these arguments. Raises what the edit raises.

    >>> from tress.edit.add import add
    >>> from tress.model.group import Group
    >>> list(edited(Document(), add, records={"hair": Group()}).records)
    ['hair']
    """
    return apply(edit(document, **arguments), document)
