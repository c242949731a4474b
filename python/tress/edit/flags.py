"""A truth value of strips and groups."""

from collections.abc import Iterable
from dataclasses import replace

from tress.base.errors import InputError
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.group import Group
from tress.model.strip import Strip


def with_flag(document: Document, names: Iterable[str], flag: str, value: bool) -> Diff:
    """Sets the field `flag` of strips and groups. Raises `InputError` where a name is neither."""
    pairs = {}
    for name in sorted(set(names)):
        before = document.records.get(name)
        if not isinstance(before, Strip | Group):
            found = "absent" if before is None else f"a {type(before).__name__}"
            raise InputError(f"Record {name!r} is {found}; a strip or a group was expected.")
        if getattr(before, flag) is not value:
            pairs[name] = (before, replace(before, **{flag: value}))
    return Diff(updated=pairs)
