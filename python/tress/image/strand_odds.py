"""How likely a patch shows strands of hair, of whatever colour: by its fine contrast, and whether that runs one way."""

import numpy as np
from numpy.typing import NDArray

from tress.image.superpixels import Superpixels

_EVEN_TEXTURE, _PER_TEXTURE = 0.4, 1.4
_EVEN_GRAIN, _PER_GRAIN = 0.57, 3.5
"""Fine texture and grain at which a patch is as likely hair as not, and logarithm of odds for each unit more: middle
and slope between hair (0.8 and 0.7 in the mean) and skin and clothes (0.0 and 0.43) in common photographs."""
_MOST_ODDS = 2.0
_RIM = 35.0
"""Step in Lab to a neighbour at which a patch's texture is half its own and half the outline of something."""


def strand_odds(patches: Superpixels) -> NDArray[np.float64]:
    """Logarithm of odds (N,) for hair, of any colour: its fine contrast is strong and runs one way."""
    odds = _PER_TEXTURE * (patches.texture - _EVEN_TEXTURE) + _PER_GRAIN * (patches.grain - _EVEN_GRAIN)
    odds = np.clip(odds, -_MOST_ODDS, _MOST_ODDS).astype(np.float64)
    return odds / (1 + (_greatest_step(patches) / _RIM) ** 4)


def _greatest_step(patches: Superpixels) -> NDArray[np.float64]:
    """(N,) largest difference in Lab to a neighbour."""
    step = np.zeros(patches.count)
    first, second = patches.edges.T
    difference = color_steps(patches, patches.edges)
    np.maximum.at(step, first, difference)
    np.maximum.at(step, second, difference)
    return step


def color_steps(patches: Superpixels, edges: NDArray[np.int32]) -> NDArray[np.float64]:
    """(E,) difference in Lab of neighbours."""
    return np.linalg.norm(patches.lab[edges[:, 0]] - patches.lab[edges[:, 1]], axis=1)
