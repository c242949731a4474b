"""Pictures of toon shading: hairdos of strips from four sides, and what its settings do."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from tools.pictures.sheets import rows, save, side_by_side
from tress.base.tone_ramp import ToneParams
from tress.methods.strips.appearance import Color, for_style, strips_scene, view
from tress.methods.strips.hairdo import hairdo
from tress.model.document import Document
from tress.render.outline import OutlineParams
from tress.render.ring import RingParams
from tress.render.styles.toon import ToonStyle
from tress.render.views import framed

Array = np.ndarray[Any, Any]

HAIRDOS: tuple[tuple[str, Color], ...] = (
    ("bob", (0.085, 0.038, 0.017)),
    ("ponytail", (0.42, 0.16, 0.03)),
    ("wavy_shoulder", (0.05, 0.07, 0.22)),
)
VIEWS = (0.0, 45.0, 90.0, 180.0)
WIDTH, HEIGHT = 400, 500
PLAIN = ToonStyle()
SETTINGS: tuple[tuple[str, ToonStyle], ...] = (
    ("as it comes", PLAIN),
    ("tones=4", replace(PLAIN, tones=ToneParams(tones=4, spread=0.6))),
    ("highlight=0.93, lowlight=-0.2", replace(PLAIN, tones=ToneParams(highlight=0.93, lowlight=-0.2))),
    ("meld=0", replace(PLAIN, meld=0.0)),
    ("ring by fraction", replace(PLAIN, ring=RingParams(by="fraction", fraction=0.3))),
    ("width_px=4, step_m=0.003", replace(PLAIN, lines=OutlineParams(width_px=4, step_m=0.003))),
)


def toon_shading(_: Path) -> None:
    """Three hairdos from four sides, and one in several settings."""
    documents = {name: hairdo(name) for name, _ in HAIRDOS}
    sheets = [
        side_by_side([_seen(documents[name], PLAIN, angle, color) for angle in VIEWS], [name, *[""] * 3])
        for name, color in HAIRDOS
    ]
    save(rows(sheets), "toon_hairdos")
    name, color = HAIRDOS[2]
    pictures = [_seen(documents[name], style, 30.0, color) for _, style in SETTINGS]
    captions = [words for words, _ in SETTINGS]
    save(rows([side_by_side(pictures[i : i + 3], captions[i : i + 3]) for i in (0, 3)]), "toon_settings")


def _seen(document: Document, style: ToonStyle, angle: float, color: Color) -> Array:
    scene = strips_scene(document, color=color, **for_style(style))
    camera = framed(scene, width=WIDTH, height=HEIGHT)
    return view(scene, camera, style=style, azimuth_rad=math.radians(angle))
