"""What colour this person's skin has: a Gaussian over hue, saturation and brightness of samples from the face.

Shade moves a colour along its brightness and leaves the ratios of its channels; so the ratios are held tightly and the
brightness loosely. Samples of eyebrows, beards and glints are shed by two rounds that keep the middle. Limits: of
black-and-white photographs only the brightness tells; clothes of the skin's own colour are skin.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.color import srgb_to_linear

FLOOR = 0.02
"""Added to linear channels, so that the noise of dark pixels does not count as hue."""
LEAST_SPREAD = np.array([0.07, 0.07, 0.35])
"""Standard deviations that every skin has at least: log R/G, log B/G, log brightness."""
SHADED = 0.25
"""Share of the samples that counts as in shade."""
KEPT = 9.0
"""Squared distance within which a sample is kept."""


@dataclass(frozen=True)
class SkinModel:
    """`mean` (3,) and `precision` (3, 3) of a skin's `skin_features`; `color` (3,) sRGB in [0, 1]: the median of what
    does not lie in shade."""

    mean: NDArray[np.float64]
    precision: NDArray[np.float64]
    color: NDArray[np.float32]

    def distance_sq(self, color: NDArray[np.floating]) -> NDArray[np.float32]:
        """Squared Mahalanobis distance (...,) of colours (..., 3) sRGB in [0, 1]."""
        away = skin_features(color) - self.mean.astype(np.float32)
        return np.einsum("...a,ab,...b->...", away, self.precision.astype(np.float32), away, optimize=True)


def skin_features(color: NDArray[np.floating]) -> NDArray[np.float32]:
    """log R/G, log B/G and log brightness (..., 3) of colours (..., 3) sRGB in [0, 1]."""
    r, g, b = np.moveaxis(srgb_to_linear(np.asarray(color, np.float32)) + np.float32(FLOOR), -1, 0)
    return np.stack([np.log(r / g), np.log(b / g), np.log((r + g + b) / 3)], axis=-1)


def skin_model(samples: NDArray[np.floating]) -> SkinModel:
    """The model of at least one sample (N, 3) sRGB in [0, 1] from a face, most of them skin."""
    features = skin_features(samples).astype(np.float64)
    mean = np.median(features, axis=0)
    spread = 1.5 * np.median(np.abs(features - mean), axis=0)
    covariance = np.diag(np.square(spread) + np.square(LEAST_SPREAD))
    kept = np.ones(len(features), bool)
    for _ in range(2):
        away = features - mean
        kept = np.einsum("na,ab,nb->n", away, np.linalg.inv(covariance), away) <= KEPT
        mean = features[kept].mean(axis=0)
        away = features[kept] - mean
        covariance = np.einsum("na,nb->ab", away, away) / len(away) + np.diag(np.square(LEAST_SPREAD))
    lit = kept & (features[:, 2] >= np.quantile(features[kept, 2], SHADED))
    return SkinModel(mean, np.linalg.inv(covariance), np.median(samples[lit], axis=0).astype(np.float32))
