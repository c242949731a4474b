"""The strips that an edit is about; what is locked refuses."""

from collections.abc import Iterable

from tress.base.errors import InputError
from tress.model.document import Document
from tress.model.strip import Strip
from tress.model.strips import locked_by, strip_names


class LockedError(InputError):
    """A strip is locked, or lies in a locked group."""


def editable_strips(document: Document, names: Iterable[str]) -> dict[str, Strip]:
    """The strips that `names` stand for (strips, and all within groups), in alphabetical order.

    Raises `InputError` where a name is neither, `LockedError` where one is locked.
    """
    found = strip_names(document, names)
    refuse_locked(document, found)
    strips = document.of_type(Strip)
    return {name: strips[name] for name in found}


def refuse_locked(document: Document, names: Iterable[str]) -> None:
    """Raises `LockedError` where a strip or group is locked, or lies in a locked group; other records never are."""
    for name in names:
        lock = locked_by(document, name)
        if lock:
            where = "" if lock == name else f" by the group {lock!r}"
            raise LockedError(f"{name!r} is locked{where}; unlock it to change it.")
