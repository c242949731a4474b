"""How far a stroke's word carries: over connected patches that look like what was stroked.

A user draws a line across a hat and means the hat. So what a stroke says is passed on from patch to neighbouring patch,
at no cost as long as they look like the stroked ones and at more the less they do; an edge stops it, and so does what
strokes of other layers claim as well.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tress.image.labels import LAYER_COUNT
from tress.image.mixture import fitted_mixture, log_density
from tress.image.reach import reach

_FLOOR: Final = np.array([3.0, 2.0, 2.0, 6.0, 8.0]) ** 2
"""Variance of L, a, b, scaled texture and grain that a stroke allows at least."""
_UNLIKE: Final = 3.0
"""Logarithm of likelihood, below that of nearly all stroked patches, up to which a patch is alike."""
_TOLL: Final = 0.5
"""Toll for each unit of it beyond that."""
_PER_PATCH: Final = 0.05
"""Toll for each patch on the way."""


def spread_of_strokes(
    samples: NDArray[np.float64], *, strokes: NDArray[np.uint8], edges: NDArray[np.int32]
) -> NDArray[np.float64]:
    """How much (N, 4 layers), in [0, 1], the strokes speak for each layer at every patch; 1 on the strokes themselves.

    `samples` (N, 5) are the patches' features, `strokes` (N,) a label or another value for none, `edges` (E, 2) their
    neighbours. Source of the idea: geodesic segmentation, Bai & Sapiro 2007.
    """
    spread = np.zeros((len(samples), LAYER_COUNT))
    for layer in range(LAYER_COUNT):
        drawn = strokes == layer
        if drawn.any():
            shown = fitted_mixture(samples, weights=drawn, count=2, floor=_FLOOR)
            likelihood = log_density(shown, samples)
            lack = np.quantile(likelihood[drawn], 0.1) - _UNLIKE - likelihood
            toll = _PER_PATCH + _TOLL * np.maximum(lack, 0)
            toll[(strokes < LAYER_COUNT) & ~drawn] = np.inf
            spread[:, layer] = np.exp(-reach(toll, edges=edges, start=drawn))
            spread[drawn] = np.arange(LAYER_COUNT) == layer
    return spread
