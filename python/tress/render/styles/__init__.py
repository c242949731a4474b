"""Shading styles, one a file. A new one is its file and a line here."""

from typing import Final

from tress.render.style import Style
from tress.render.styles.fibre import FibreStyle
from tress.render.styles.gouraud import GouraudStyle
from tress.render.styles.photo import PhotoStyle
from tress.render.styles.textured import TexturedStyle
from tress.render.styles.toon import ToonStyle

STYLES: Final[tuple[type[Style], ...]] = (PhotoStyle, FibreStyle, GouraudStyle, TexturedStyle, ToonStyle)
