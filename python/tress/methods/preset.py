"""Hairdos by name, of any method."""

import difflib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from tress.base.errors import InputError
from tress.model.document import Document

Settings = TypeVar("Settings")
Grow = Callable[[Document, Settings], Document]


@dataclass(frozen=True)
class Preset(Generic[Settings]):
    """A hairdo: its `name`, and `grow`, which adds it to a document that holds a `head` with the mask `scalp`."""

    name: str
    grow: Grow[Settings]

    @property
    def words(self) -> str:
        """One sentence on what it looks like."""
        return (self.grow.__doc__ or "").split("\n")[0]


def presets_of(*grow: Grow[Settings]) -> tuple[Preset[Settings], ...]:
    """Presets with the names of the functions that grow them."""
    return tuple(Preset(each.__name__, each) for each in grow)  # type: ignore[attr-defined]


def chosen(presets: Sequence[Preset[Settings]], name: str) -> Preset[Settings]:
    """The preset of that name. Raises `InputError` that names them all."""
    known = {preset.name: preset for preset in presets}
    if name in known:
        return known[name]
    nearest = difflib.get_close_matches(name, known, n=1, cutoff=0.6)
    meant = f" did you mean {nearest[0]}?" if nearest else ""
    raise InputError(f"There is no preset {name!r};{meant} one of {', '.join(known)} was expected.")
