"""Closed-form matting, in the compiled core."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError

TRIMAP_BACKGROUND = 0
TRIMAP_UNKNOWN = 128
TRIMAP_FOREGROUND = 255


@dataclass(frozen=True)
class Alpha:
    """`alpha` (H, W) float32 in [0, 1]; the solver's `iterations`, relative `residual` and whether it `converged`."""

    alpha: NDArray[np.float32]
    iterations: int
    residual: float
    converged: bool


def closed_form_alpha(
    image: NDArray[np.floating],
    *,
    trimap: NDArray[np.uint8],
    epsilon: float = 1e-6,
    tolerance: float = 1e-5,
    max_iterations: int = 500,
    settle: float = 0.0,
) -> Alpha:
    """Alpha of `image` (H, W, 3) in [0, 1] under `trimap` (H, W) uint8: 0 background, 255 foreground, else unknown.

    The image should be coded (sRGB), where equal steps look equal. `epsilon` (1e-7 to 1e-5) is the colour variance
    below which a 3 x 3 window counts as flat; `tolerance` is the relative residual to stop at. Where the answer for
    half the size is within `settle` of 0 or 1 all around, it counts as known, which takes a third of the time.
    Bit-identical for any number of threads. Source: Levin, Lischinski & Weiss 2008.

    Raises `InputError` where shapes do not fit, the image is smaller than 3 x 3 or nothing is known.
    """
    _require(image, trimap.shape, "trimap")
    try:
        result = _core.matting_alpha(
            np.ascontiguousarray(image, np.float32),
            np.ascontiguousarray(trimap, np.uint8),
            float(epsilon),
            float(tolerance),
            int(max_iterations),
            float(settle),
        )
    except ValueError as error:
        raise InputError(f"{error}.") from error
    return Alpha(*result)


def _require(image: NDArray[np.floating], shape: tuple[int, ...], name: str) -> None:
    if image.ndim != 3 or image.shape[2] != 3:
        raise InputError(f"the image has the shape {image.shape}; (height, width, 3) was expected.")
    if shape != image.shape[:2]:
        raise InputError(f"the {name} has the shape {shape}; {image.shape[:2]} was expected.")
    if not np.isfinite(image).all():
        raise InputError("the image holds values that are not finite.")
