"""Identifiers that a document does not have yet."""

import re
from collections.abc import Iterable

from tress.model.document import Document

NUMBERED = re.compile(r"(.*?)_(\d+)")


class FreshNames:
    """Hands out `stem_1`, `stem_2` … as far as they are free, each once.

    >>> fresh = FreshNames(Document())
    >>> fresh.next("lock"), fresh.next("lock_1"), fresh.next("bang")
    ('lock_1', 'lock_2', 'bang_1')
    """

    def __init__(self, document: Document, *, taken: Iterable[str] = ()) -> None:
        self._taken = set(document.records) | set(taken)
        self._last: dict[str, int] = {}

    def next(self, name: str) -> str:
        """The name, numbered."""
        match = NUMBERED.fullmatch(name)
        stem = match[1] if match and match[1] else name
        number = self._last.get(stem, 0) + 1
        while f"{stem}_{number}" in self._taken:
            number += 1
        self._last[stem] = number
        self._taken.add(f"{stem}_{number}")
        return f"{stem}_{number}"
