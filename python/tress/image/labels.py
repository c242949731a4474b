"""The four layers of a portrait and their labels, as every label picture and strokes map uses them."""

from typing import Final

BACKGROUND: Final = 0
BODY: Final = 1
FACE: Final = 2
HAIR: Final = 3
LAYER_COUNT: Final = 4
