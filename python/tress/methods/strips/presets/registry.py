"""The list of presets: a new one is its file and its line here."""

from typing import Final

from tress.methods.preset import Preset, chosen, presets_of
from tress.methods.strips.params import StripsParams
from tress.methods.strips.presets.bob import bob
from tress.methods.strips.presets.long_straight import long_straight
from tress.methods.strips.presets.ponytail import ponytail
from tress.methods.strips.presets.short_crop import short_crop
from tress.methods.strips.presets.side_parting import side_parting
from tress.methods.strips.presets.wavy_shoulder import wavy_shoulder

PRESETS: Final[tuple[Preset[StripsParams], ...]] = presets_of(
    long_straight, bob, short_crop, side_parting, wavy_shoulder, ponytail
)


def preset_of(name: str) -> Preset[StripsParams]:
    """The preset of that name. Raises `InputError` that names them all.

    >>> preset_of("bob").name
    'bob'
    """
    return chosen(PRESETS, name)
