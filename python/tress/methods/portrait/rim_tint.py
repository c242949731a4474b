"""Tint of the hair's soft rim: that of the solid hair near it.

What the matte gets wrong at the rim, and the coloured fringes of lenses, are a matter of tint more than of brightness,
and show as coloured seams once the head turns. So the brightness of the rim is kept, and its tint drawn towards that of
the solid hair around it. Next to the background also the brightness is held to what that hair has: from the side, the
few pixels there are drawn out to a broad band, and light from behind would run over the head as a bright one.
"""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.color import luminance

_SOLID: Final = 0.97
"""Alpha from which hair is solid and keeps its tint."""
_THIN: Final = 0.6
"""Alpha up to which the tint is drawn as far as it may be."""
_REACH_PX: Final = 6.0
_LEAST_NEAR: Final = 1e-3
_SPREADS: Final = 2.0
"""Standard deviations from the mean brightness near by within which the outer rim's brightness is kept."""
_DARKEST: Final = 1e-3


def with_rim_tint(
    color: NDArray[np.float32],
    *,
    foreground: NDArray[np.float32],
    alpha: NDArray[np.float32],
    outer: NDArray[np.bool_],
    amount: float,
) -> NDArray[np.float32]:
    """`color` (H, W, 3) float32 linear, its tint drawn by `amount` (0 to 1) towards the rim's neighbours'.

    `foreground` (H, W, 3) linear and `alpha` (H, W) are the matte's, `outer` (H, W) says which pixels are next to the
    background; the others keep their luminance, but for black. Solid hair, and rims without any within some 20 px,
    stay as they are.
    """
    solid = (alpha > _SOLID).astype(np.float32)
    near = cv2.GaussianBlur(solid, (0, 0), _REACH_PX)
    light = luminance(foreground)
    known = np.dstack([foreground, light * light]) * solid[..., None]
    mean = cv2.GaussianBlur(known, (0, 0), _REACH_PX) / np.maximum(near, _LEAST_NEAR)[..., None]
    hair = mean[..., :3]
    usual = luminance(hair)
    spread = np.sqrt(np.maximum(mean[..., 3] - usual * usual, 0))
    own = luminance(color)
    wanted = np.where(outer, np.clip(own, usual - _SPREADS * spread, usual + _SPREADS * spread), own)
    brightness = wanted / np.maximum(usual, _DARKEST)
    rim = np.where(outer, cv2.erode(alpha, np.ones((3, 3), np.uint8)), alpha)
    share = amount * np.clip((_SOLID - rim) / (_SOLID - _THIN), 0, 1) * (near > _LEAST_NEAR)
    return (color + share[..., None] * (hair * brightness[..., None] - color)).astype(np.float32)
