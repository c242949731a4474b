"""Changing knots."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from tress.base.errors import InputError
from tress.edit.selection import editable_strips
from tress.model.diff import Diff
from tress.model.document import Document


def set_knots(document: Document, *, names: Iterable[str], knots_u: Any = None, knots_v: Any = None) -> Diff:
    """Gives strips other knots along, across, or both; the control points stay, so the surface changes.

    One knot more or less than before is one degree more or less. Raises `InputError` for vectors that are too short or
    long, decrease or span nothing (see `Strip`), where none is given, and where a strip is locked.
    """
    changes = {"knots_u": knots_u, "knots_v": knots_v}
    given = {name: values for name, values in changes.items() if values is not None}
    if not given:
        raise InputError("No knots are given; knots along, across or both were expected.")
    strips = editable_strips(document, names)
    return Diff(updated={name: (before, replace(before, **given)) for name, before in strips.items()})
