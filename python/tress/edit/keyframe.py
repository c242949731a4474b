"""Keyframing strips and groups."""

from typing import Any

from tress.base.errors import InputError
from tress.edit.fresh_names import FreshNames
from tress.edit.selection import refuse_locked
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.group import Group
from tress.model.keyframes import Keyframes
from tress.model.strip import Strip
from tress.model.strips import groups_named


def set_keyframes(document: Document, *, target: str, name: str = "", **fields: Any) -> Diff:
    """Gives a strip or group a motion: `fields` are those of `Keyframes` (`times`, `values`, `interpolation` …).

    The record is `name`, or a new one: other motions of the target stay, and displacements add up. To take a motion
    away, delete its record. Raises `InputError` for fields that do not fit (see `Keyframes`), where the target is no
    strip or group or is locked, and where `name` is another record.
    """
    if not isinstance(document.records.get(target), Strip | Group):
        raise InputError(
            f"Record {target!r} is no strip or group of the document; keyframes move these{groups_named(document)}."
        )
    refuse_locked(document, [target])
    after = Keyframes(target=target, **fields)
    key = name or FreshNames(document).next(f"{target}_motion")
    before = document.records.get(key)
    if before is not None and not isinstance(before, Keyframes):
        raise InputError(f"Record {key!r} is a {type(before).__name__}; keyframes were expected.")
    after.check_in(document, name=key)
    if before is None:
        return Diff(added={key: after})
    refuse_locked(document, [before.target])
    return Diff(updated={key: (before, after)})
