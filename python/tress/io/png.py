"""8-bit pictures as PNG, which loses nothing."""

import io
from typing import Any

import numpy as np
from PIL import Image, UnidentifiedImageError

from tress.base.errors import FormatError


def encode_png(pixels: np.ndarray[Any, Any]) -> bytes:
    """The bytes of a PNG with (H, W, 3 | 4) uint8 pixels, sRGB."""
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "png", compress_level=3)
    return buffer.getvalue()


def decode_png(data: bytes, *, name: str) -> np.ndarray[Any, Any]:
    """The (H, W, 3 | 4) uint8 pixels of a PNG; `name` stands in the message of the `FormatError` that is raised."""
    try:
        with Image.open(io.BytesIO(data), formats=["png"]) as image:
            if image.mode not in ("RGB", "RGBA"):
                raise FormatError(f"Picture {name!r} has mode {image.mode}; RGB or RGBA was expected.")
            return np.array(image)
    except (OSError, UnidentifiedImageError, Image.DecompressionBombError, SyntaxError, ValueError) as error:
        raise FormatError(f"Picture {name!r} is damaged.") from error
