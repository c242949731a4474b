"""The keyframes of a strip, for its copy."""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.edit.fresh_names import FreshNames
from tress.model.document import Document
from tress.model.keyframes import Keyframes

Array = np.ndarray[Any, Any]


class CopiedMotion:
    """Makes the keyframes of copies: of every record that moves a strip by itself, one for the copy."""

    def __init__(self, document: Document, fresh: FreshNames) -> None:
        self._fresh = fresh
        self._by_target: dict[str, list[tuple[str, Keyframes]]] = {}
        for name, motion in document.of_type(Keyframes).items():
            self._by_target.setdefault(motion.target, []).append((name, motion))

    def of(
        self,
        strip: str,
        *,
        copy: str,
        in_root: Array | None = None,
        in_head: Array | None = None,
        shift: Array | None = None,
        mirrored: bool = False,
    ) -> dict[str, Keyframes]:
        """The motions of `strip` as those of `copy`: vectors turned by `in_root` or `in_head` (3, 3), by their frame;
        positions moved by `shift` (3,) too; columns in reverse where the copy is `mirrored`."""
        result = {}
        for name, motion in self._by_target.get(strip, []):
            turn = in_head if motion.frame == "head" else in_root
            values = _turned(motion.values, turn, mirrored)
            if shift is not None and motion.kind == "position":
                values = values + shift
            tangents = None if motion.tangents is None else _turned(motion.tangents, turn, mirrored)
            copied = replace(motion, target=copy, values=values, tangents=tangents)
            result[self._fresh.next(name)] = copied
        return result


def _turned(values: Array, turn: Array | None, mirrored: bool) -> Array:
    found = values if turn is None else values @ turn.T
    return found[:, :, ::-1] if mirrored else found
