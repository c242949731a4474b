"""The corrections that the documentation shows: the number of the portrait, and what stands in the file."""

from collections.abc import Mapping
from typing import Any, Final

STROKES: Final[tuple[str, Mapping[str, Any]]] = (
    "044",
    {
        "strokes": [
            {"layer": "body", "width": 40, "points": [[340, 360], [340, 220], [430, 110], [560, 90], [670, 170]]},
            {"layer": "body", "width": 40, "points": [[360, 280], [500, 250], [680, 300], [715, 390]]},
            {"layer": "body", "width": 40, "points": [[250, 740], [330, 850], [430, 870]]},
            {"layer": "body", "width": 30, "points": [[180, 560], [170, 760], [200, 880], [420, 930], [650, 970]]},
            {"layer": "body", "width": 20, "points": [[880, 850], [920, 880]]},
            {"layer": "face", "width": 20, "points": [[480, 690], [500, 780]]},
            {"layer": "hair", "width": 16, "points": [[130, 760], [270, 600], [310, 480]]},
            {"layer": "hair", "width": 25, "points": [[660, 430], [660, 600], [640, 850]]},
            {"layer": "hair", "width": 25, "points": [[760, 640], [900, 780]]},
        ]
    },
)

LANDMARKS: Final[tuple[str, Mapping[str, Any]]] = (
    "astronaut",
    {"right_eye": [204, 103], "left_eye": [247, 105], "nose": [223, 131], "mouth": [223, 146], "chin": [221, 177]},
)

DEPTHS: Final[tuple[str, Mapping[str, Any]]] = (
    "031",
    {"strokes": [{"depth_m": 0.1, "width": 40, "points": [[350, 560], [390, 700], [460, 900]]}]},
)
