"""How likely what the cut calls hair is a hat or a scarf over the head.

A covering differs from the hair below it: its colour is another, or its texture has fewer strands in it. Where no hair
hangs below, nothing can be compared and nothing is said.
"""

import numpy as np
from numpy.typing import NDArray

from tress.image.superpixels import Superpixels

_LEAST_BELOW = 0.3
"""Area below the chin's line, as part of that above, from which on there is hair to compare with."""
_COLOR_STEP, _STRAND_STEP = 22.0, 0.65
"""Difference in Lab, and in logarithm of odds for strands, at which a covering is as likely as not."""


def covering(
    patches: Superpixels, *, hair: NDArray[np.bool_], rooted: NDArray[np.bool_], strands: NDArray[np.float64]
) -> float:
    """Evidence >= 0 that the rooted part of `hair` (N,) is a covering: 1 is as likely as not.

    `rooted` (N,) bool: where hair may have its roots. `strands` (N,): logarithm of odds that a patch shows strands.
    """
    over, below = hair & rooted, hair & ~rooted
    if patches.area[below].sum() < _LEAST_BELOW * patches.area[over].sum() or not over.any():
        return 0.0
    color = np.linalg.norm(_mean(patches, over, patches.lab) - _mean(patches, below, patches.lab))
    bareness = _mean(patches, below, strands) - _mean(patches, over, strands)
    return float(max(color / _COLOR_STEP, bareness / _STRAND_STEP, 0.0))


def _mean(patches: Superpixels, where: NDArray[np.bool_], values: NDArray[np.floating]) -> NDArray[np.float64]:
    return np.average(values[where].astype(np.float64), weights=patches.area[where], axis=0)
