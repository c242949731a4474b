"""Colours as people write them."""

import re

import numpy as np

from tress.base.color import linear_to_srgb8, srgb_to_linear
from tress.base.errors import ParameterError

_HEX = re.compile(r"#?([0-9a-fA-F]{6})")


def linear_of_hex(text: str) -> tuple[float, float, float]:
    """Linear light of an sRGB colour like "#3a2415"; the # may be missing. Raises `ParameterError` for other texts.

    >>> linear_of_hex("#ff0000")
    (1.0, 0.0, 0.0)
    """
    found = _HEX.fullmatch(text.strip())
    if found is None:
        raise ParameterError(f"{text!r} is no colour; six hexadecimal digits were expected, such as #3a2415.")
    red, green, blue = srgb_to_linear(np.frombuffer(bytes.fromhex(found[1]), np.uint8))
    return float(red), float(green), float(blue)


def hex_of_linear(color: tuple[float, float, float]) -> str:
    """The nearest sRGB colour in hexadecimal digits.

    >>> hex_of_linear((1.0, 0.0, 0.0))
    '#ff0000'
    """
    return "#" + linear_to_srgb8(np.asarray(color)).tobytes().hex()
