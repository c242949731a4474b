"""A picture that lies on a mesh."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.model.record import Record, array


@dataclass(frozen=True, eq=False)
class Texture(Record):
    """8-bit sRGB pixels, RGB or RGBA (straight alpha), the top row first.

    Texture coordinates are (u, v) in [0, 1], u to the right and v UP, as in USD and OBJ: (0, 0) is the bottom left
    corner of the picture, so that a point falls into column u * W and row (1 - v) * H.
    Raises `InputError` for other shapes.
    """

    pixels: np.ndarray[Any, Any] = array("u1", "H", "W", "C", doc="sRGB, the top row first.")

    def check(self) -> None:
        """Three or four channels, and at least one pixel."""
        if self.pixels.shape[2] not in (3, 4) or self.pixels.size == 0:
            raise InputError(f"Texture.pixels has shape {self.pixels.shape}; (H, W, 3) or (H, W, 4) was expected.")
