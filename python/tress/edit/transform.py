"""Moving, turning and scaling records."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.edit.selection import refuse_locked
from tress.model.diff import Diff
from tress.model.document import Document


def transform(document: Document, *, names: Iterable[str], new_from_old: np.ndarray[Any, Any]) -> Diff:
    """Takes the named records through a rotation, shift and even scaling, a (4, 4) matrix in metres.

    Each record says for itself what moves: points and positions; the radius of strands grows with the scale; a camera
    goes on seeing the same; a strip on a head goes with the head, and takes on the scale alone. Raises `InputError`
    where a record is absent, locked or cannot be moved, or the matrix does anything else.
    """
    pairs = {}
    wanted = sorted(set(names))
    refuse_locked(document, [name for name in wanted if name in document.records])
    for name in wanted:
        before = document.records.get(name)
        if before is None:
            raise InputError(f"There is no record {name!r} to transform.")
        pairs[name] = (before, before.transformed(new_from_old))
    return Diff(updated=pairs)
