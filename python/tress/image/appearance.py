"""What each layer looks like in this one photograph: mixtures of colour and texture, learnt from it."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tress.image.labels import BACKGROUND, BODY, FACE, HAIR, LAYER_COUNT
from tress.image.mixture import Mixture, fitted_mixture, log_density
from tress.image.superpixels import Superpixels

_TEXTURE_SCALE: Final = 12.0
"""Steps of Lab that a doubling-and-a-half (factor e) of the fine contrast counts as."""
_GRAIN_SCALE: Final = 15.0
_FLOOR: Final = np.array([3.0, 2.0, 2.0, 3.0, 3.0]) ** 2
"""Variance that no mixture component falls below: L, a, b, scaled texture and grain."""
_COMPONENTS: Final = {BACKGROUND: 5, BODY: 5, FACE: 3, HAIR: 4}
_OUTLIERS: Final = 0.02
"""Share of a layer that looks like anything in the photograph."""
_TRIMMINGS: Final = 4
_TRIM_SQ: Final = 9.0
"""Squared Mahalanobis distance beyond which a patch of the face is not skin."""
_FIRST_TRIM_SQ: Final = 16.0
"""The same before the first trimming, from the median, where texture and colours are not yet known to go together."""
_NORMAL_QUARTILE: Final = 0.6745
"""Median distance from the mean of a normal distribution of variance 1."""
_STROKED: Final = 0.35
"""Share of a layer that looks like its strokes."""
_BARE_SKIN: Final = 0.15
"""Share of the body that looks like the face: neck, shoulders, hands."""
_SHADES: Final = ((0.85, 0.2), (0.7, 0.12))
"""Skin and hair in shade: factor of (L + 16, a, b), as less light does it, and its share of the layer."""
_SHINE: Final = (0.1, 15.0, 0.7)
"""Skin that shines: its share of the face, how much lighter it is (L), and what is left of its a and b."""


@dataclass(frozen=True)
class Appearance:
    """Mixture of every layer, by label, and the one of the whole photograph (`anything`)."""

    mixtures: tuple[Mixture, ...]
    anything: Mixture


def features(patches: Superpixels) -> NDArray[np.float64]:
    """(N, 5) float64 of every superpixel: L, a, b, fine texture and grain, in steps of like size."""
    fine = [_TEXTURE_SCALE * patches.texture, _GRAIN_SCALE * patches.grain]
    return np.column_stack([patches.lab, *fine]).astype(np.float64)


def learnt_appearance(
    samples: NDArray[np.float64], *, weights: NDArray[np.float64], strokes: NDArray[np.uint8]
) -> Appearance:
    """Mixtures of all layers from `samples` (N, 5) with `weights` (N, 4 layers) >= 0.

    What the user stroked (`strokes` (N,): a label, or any other value) makes up a fixed share of its layer, however
    little it is: it is what the photograph alone got wrong.
    """
    anything = fitted_mixture(samples, weights=weights.sum(axis=1), count=1, floor=_FLOOR, iterations=0)
    weights = weights.copy()
    weights[:, FACE] = _of_one_cluster(samples, weights[:, FACE])
    learnt = [
        fitted_mixture(samples, weights=weights[:, layer], count=_COMPONENTS[layer], floor=_FLOOR)
        for layer in range(LAYER_COUNT)
    ]
    for layer in range(LAYER_COUNT):
        if (strokes == layer).any():
            shown = fitted_mixture(samples, weights=strokes == layer, count=2, floor=_FLOOR)
            learnt[layer] = _joined(learnt[layer], shown, share=_STROKED)
    for layer in (FACE, HAIR):
        learnt[layer] = _with_shades(learnt[layer])
    learnt[FACE] = _with_shine(learnt[FACE])
    return Appearance(tuple(learnt), anything)


def log_likelihood(appearance: Appearance, samples: NDArray[np.float64]) -> NDArray[np.float64]:
    """Natural logarithm (N, 4 layers) of how likely every layer is to look like `samples` (N, 5)."""
    logs = np.column_stack([log_density(mixture, samples) for mixture in appearance.mixtures])
    logs[:, BODY] = np.logaddexp(np.log(1 - _BARE_SKIN) + logs[:, BODY], np.log(_BARE_SKIN) + logs[:, FACE])
    anything = log_density(appearance.anything, samples)
    return np.logaddexp(np.log(1 - _OUTLIERS) + logs, np.log(_OUTLIERS) + anything[:, None])


def _of_one_cluster(samples: NDArray[np.float64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weights without what is far from the middle of the cluster: skin without eyes, brows, lips and fringe."""
    kept = np.where(_from_median_sq(samples, weights) < _FIRST_TRIM_SQ, weights, 0.0)
    for _ in range(_TRIMMINGS):
        if kept.sum() <= 0:
            return weights
        middle = fitted_mixture(samples, weights=kept, count=1, floor=_FLOOR, iterations=0)
        away = samples - middle.mean[0]
        distance_sq = np.einsum("ni,ij,nj->n", away, np.linalg.inv(middle.covariance[0]), away)
        kept = np.where(distance_sq < _TRIM_SQ, weights, 0.0)
    return kept


def _from_median_sq(samples: NDArray[np.float64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Squared distance (N,) from the weighted median, in spreads that a quarter of other things widens little."""
    away = samples - _weighted_median(samples, weights)
    deviation = _weighted_median(np.abs(away), weights) / _NORMAL_QUARTILE
    return (away**2 / (deviation**2 + _FLOOR)).sum(axis=1)


def _weighted_median(values: NDArray[np.float64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of every column of `values` (N, D)."""
    order = np.argsort(values, axis=0, kind="stable")
    mass = np.cumsum(weights[order], axis=0)
    row = (mass < mass[-1] / 2).sum(axis=0)
    return np.take_along_axis(values, np.take_along_axis(order, row[None], axis=0), axis=0)[0]


def _joined(first: Mixture, second: Mixture, *, share: float) -> Mixture:
    return Mixture(
        np.concatenate([(1 - share) * first.weight, share * second.weight]),
        np.concatenate([first.mean, second.mean]),
        np.concatenate([first.covariance, second.covariance]),
    )


def _with_shine(skin: Mixture) -> Mixture:
    share, lighter, paler = _SHINE
    mean = skin.mean * [1, paler, paler, 1, 1] + [lighter, 0, 0, 0, 0]
    return _joined(skin, Mixture(skin.weight, mean, skin.covariance), share=share)


def _with_shades(lit: Mixture) -> Mixture:
    rest = 1 - sum(share for _, share in _SHADES)
    weight, mean = [rest * lit.weight], [lit.mean]
    for factor, share in _SHADES:
        shaded = lit.mean.copy()
        shaded[:, 0] = factor * (shaded[:, 0] + 16) - 16
        shaded[:, 1:3] *= factor
        weight.append(share * lit.weight)
        mean.append(shaded)
    repeated = np.concatenate([lit.covariance] * (1 + len(_SHADES)))
    return Mixture(np.concatenate(weight), np.concatenate(mean), repeated)
