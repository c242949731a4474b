"""How much of a picture passes an alpha test, as a graphics processor makes it: on bilinearly interpolated alpha.

Both functions look at 4 x 4 points a texel, repeat alpha beyond the edge, give the same bits on any number of cores and
raise `InputError` for pictures without texels and numbers that are not finite.
"""

from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked

Array = np.ndarray[Any, Any]


def alpha_coverage(alpha: Array, *, threshold: float) -> float:
    """The share of the area, [0, 1], in which `alpha` (H, W), [0, 1], exceeds `threshold`.

    >>> alpha_coverage(np.array([[0.125, 0.375, 0.625, 0.875]]), threshold=0.25)
    0.75
    """
    return _core.raster_alpha_coverage(_texels(alpha), float(threshold))


def alpha_scale(alpha: Array, *, threshold: float, coverage: float) -> float:
    """The factor, 1/16 to 256, with which `min(factor * alpha, 1)` (H, W) covers nearest to `coverage`, [0, 1].

    Source: I. Castaño, Computing Alpha Mipmaps, 2010. Found by halving; alpha that is 0 everywhere cannot be helped.
    """
    return _core.raster_alpha_scale(_texels(alpha), float(threshold), float(coverage))


def _texels(alpha: Array) -> Array:
    texels = checked(alpha, name="alpha", dtype=np.float32, shape=(None, None))
    if not texels.size:
        raise InputError(f"alpha has shape {texels.shape}; at least one texel was expected.")
    return texels
