"""Pictures of the six presets of strips, and of the meadow."""

import math
from pathlib import Path
from typing import Any

import numpy as np

from examples.meadow import meadow, picture
from tools.pictures.sheets import rows, save, side_by_side
from tress.app.strips_job import StripsOptions, texture_params
from tress.base.report import Report
from tress.methods.strips.appearance import for_style, strips_scene, view
from tress.methods.strips.hairdo import hairdo
from tress.methods.strips.presets.registry import PRESETS
from tress.render.occlusion import prepared
from tress.render.style import Style
from tress.render.styles.gouraud import GouraudStyle
from tress.render.styles.textured import TexturedStyle
from tress.render.textures.strand_atlas import strand_atlas
from tress.render.views import framed

Array = np.ndarray[Any, Any]

VIEWS = (0.0, 45.0, 90.0, 180.0)
WIDTH, HEIGHT = 320, 400


def strips_presets(_: Path) -> None:
    """The six presets, the styles of strips, and the meadow."""
    save(presets_sheet(), "strips_presets")
    save(styles_sheet(), "strips_styles")
    save(meadow_picture(), "strips_meadow")


def presets_sheet() -> Array:
    """Two presets a row, each from the front, from 45 degrees, from the side and from behind."""
    sheets = [_sheet(preset.name, TexturedStyle(), VIEWS) for preset in PRESETS]
    return rows([np.concatenate(sheets[i : i + 2], axis=1) for i in range(0, len(sheets), 2)])


def styles_sheet(preset: str = "wavy_shoulder") -> Array:
    """One preset in both styles."""
    return np.concatenate([_sheet(preset, style, (30.0, 180.0)) for style in (GouraudStyle(), TexturedStyle())], axis=1)


def meadow_picture() -> Array:
    """What `examples/meadow.py` draws."""
    return picture(meadow())


def _sheet(preset: str, style: Style, angles: tuple[float, ...]) -> Array:
    options = StripsOptions(preset=preset, folder=Path())
    atlas = strand_atlas(texture_params(options), report=Report())
    scene = prepared(strips_scene(hairdo(preset, atlas=atlas), **for_style(style)))
    camera = framed(scene, width=WIDTH, height=HEIGHT)
    pictures = [view(scene, camera, style=style, azimuth_rad=math.radians(angle)) for angle in angles]
    captions = [preset if style.name == "textured" and len(angles) > 2 else style.name, *[""] * (len(angles) - 1)]
    return side_by_side(pictures, captions)
