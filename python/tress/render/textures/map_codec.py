"""How each map of an atlas is read before it is averaged, and written after."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tress.base.color import linear_to_srgb8, srgb_to_linear
from tress.render.textures.encode import direction_bytes, directions, share_bytes, shares

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class MapCodec:
    """`decode` makes float32 that may be averaged of bytes, `encode` makes bytes of it; `words` are for people."""

    decode: Callable[[Array], Array]
    encode: Callable[[Array], Array]
    words: str


_SHARE = MapCodec(shares, share_bytes, "0 to 255 for 0 to 1")

COLOR: Final = MapCodec(srgb_to_linear, linear_to_srgb8, "sRGB with straight alpha")
STRAND_ID: Final = "strand_id"
"""Numbers have no mean: the map keeps the one that weighs most."""
CODECS: Final[Mapping[str, MapCodec]] = {
    "normal": MapCodec(directions, direction_bytes, "tangent space, x right, y up (OpenGL), 128 is 0"),
    "flow": MapCodec(directions, direction_bytes, "direction from root to tip, x right, y up, z out; 128 is 0"),
    "root_to_tip": MapCodec(shares, share_bytes, "0 at the root of every strand, 255 at its tip"),
    "depth": MapCodec(shares, share_bytes, "255 near, 0 far; the range is 0.3 card widths"),
    "ambient_occlusion": MapCodec(shares, share_bytes, "255 open, 0 hidden"),
    STRAND_ID: MapCodec(shares, share_bytes, "1 to 255, a number for every strand"),
}


def codec_of(name: str) -> MapCodec:
    """The codec of a map; of one that is not known, that of shares."""
    return CODECS.get(name, _SHARE)
