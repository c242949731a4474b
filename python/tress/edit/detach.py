"""Taking strips off their surface."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from tress.edit.selection import editable_strips
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.keyframes import Keyframes
from tress.model.record import Record
from tress.model.root_frames import RootFrames, root_frames

Array = np.ndarray[Any, Any]


def detach(document: Document, *, names: Iterable[str]) -> Diff:
    """Strips without a root, where they are now; they follow no surface any more, and their own motion stays.

    A group's motion along the axes of the roots goes on along those of the head. Raises `InputError` where a name is no
    strip or group, or is locked.
    """
    strips = {name: strip for name, strip in editable_strips(document, names).items() if strip.root is not None}
    pairs: dict[str, tuple[Record, Record]] = {}
    for name, strip in strips.items():
        frames = root_frames(document, [strip.root])
        points = strip.points @ frames.axes[0].T + frames.origins[0]
        pairs[name] = (strip, replace(strip, points=points, root=None))
        for key, motion in document.of_type(Keyframes).items():
            if motion.target == name and motion.frame == "root":
                pairs[key] = (motion, _in_head(motion, frames))
    return Diff(updated=pairs)


def _in_head(motion: Keyframes, frames: RootFrames) -> Keyframes:
    values = motion.values @ frames.axes[0].T
    if motion.kind == "position":
        values = values + frames.origins[0]
    tangents = None if motion.tangents is None else motion.tangents @ frames.axes[0].T
    return replace(motion, values=values, tangents=tangents)
