"""The list of presets: a new one is its file and its line here."""

from typing import Final

from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.presets.bob_bangs import bob_bangs
from tress.methods.cartoon.presets.long_wind import long_wind
from tress.methods.cartoon.presets.ponytail import ponytail
from tress.methods.cartoon.presets.spiky import spiky
from tress.methods.cartoon.presets.twin_tails import twin_tails
from tress.methods.preset import Preset, presets_of

PRESETS: Final[tuple[Preset[CartoonParams], ...]] = presets_of(ponytail, long_wind, spiky, bob_bangs, twin_tails)
