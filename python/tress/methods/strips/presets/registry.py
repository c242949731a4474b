"""The list of presets: a new one is its file and its line here."""

import difflib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from tress.base.errors import InputError
from tress.methods.strips.params import StripsParams
from tress.methods.strips.presets.bob import bob
from tress.methods.strips.presets.long_straight import long_straight
from tress.methods.strips.presets.ponytail import ponytail
from tress.methods.strips.presets.short_crop import short_crop
from tress.methods.strips.presets.side_parting import side_parting
from tress.methods.strips.presets.wavy_shoulder import wavy_shoulder
from tress.model.document import Document


@dataclass(frozen=True)
class Preset:
    """A hairdo: its `name`, and `grow`, which adds it to a document that holds a `head` with the mask `scalp`."""

    name: str
    grow: Callable[[Document, StripsParams], Document]

    @property
    def words(self) -> str:
        """One sentence on what it looks like."""
        return (self.grow.__doc__ or "").split("\n")[0]


PRESETS: Final[tuple[Preset, ...]] = tuple(
    Preset(grow.__name__, grow) for grow in (long_straight, bob, short_crop, side_parting, wavy_shoulder, ponytail)
)


def preset_of(name: str) -> Preset:
    """The preset of that name. Raises `InputError` that names them all.

    >>> preset_of("bob").name
    'bob'
    """
    known = {preset.name: preset for preset in PRESETS}
    if name in known:
        return known[name]
    nearest = difflib.get_close_matches(name, known, n=1, cutoff=0.6)
    meant = f" did you mean {nearest[0]}?" if nearest else ""
    raise InputError(f"There is no preset {name!r};{meant} one of {', '.join(known)} was expected.")
