"""The two colours that were mixed in every pixel of a soft border, and how much of each.

Closed-form alpha is smooth where colours are alike and hazy where hair is thin; taken at its word, what it gets wrong
ends up in the hair as a halo of the backdrop. So each pixel's hair is taken to look like the solid hair nearest to it,
and its background like the nearest free background: normal distributions with the mean and variance of what is known
there. Alpha is measured again between the two means, as firmly as their variances let, and the colours are the most
likely ones given the pixel's (Bayesian matting, Chuang et al. 2001, without its search). All in linear light, where
colours add up.

Limits: a lock of another colour at the rim, where no solid hair shows it, comes out in the colour of its neighbours.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tress.base.parallel import in_bands, together
from tress.image.near_colors import NearColors, near_colors

_SOLID: Final = 0.9
"""Alpha from which on a pixel tells what the layer looks like, and 1 less which it tells about the background."""
_NOISE: Final = 1e-5
"""Variance of a pixel's light."""
_ROUNDS: Final = 2
_LEAST_SHARE: Final = 1e-3

_Picture = NDArray[np.float32]
_Parts = tuple[_Picture, ...]


@dataclass(frozen=True)
class Unmixed:
    """`alpha` (H, W), `foreground` and `background` (H, W, 3), all float32 in [0, 1], the colours linear."""

    alpha: NDArray[np.float32]
    foreground: NDArray[np.float32]
    background: NDArray[np.float32]


def unmixed(
    light: NDArray[np.float32], *, alpha: NDArray[np.float32], alpha_error: float = 0.5, variety: float = 0.5
) -> Unmixed:
    """The parts of the picture `light` (H, W, 3), linear, whose first `alpha` (H, W) in [0, 1] may be off.

    `alpha_error` is the standard error of `alpha`; where it is 0 or 1 it stays. `variety` scales the variance of the
    foreground's colours. alpha F + (1 - alpha) B is the picture wherever B need not leave [0, 1] for that.
    Cost: about 60 ms for 500 x 500 pixels.
    """
    front, back = together(
        lambda: near_colors(light, weight=_ramp(alpha, _SOLID) ** 2),
        lambda: near_colors(light, weight=_ramp(1 - alpha, _SOLID) ** 2),
    )

    def parts(light: _Picture, alpha: _Picture, front: _Picture, back: _Picture, *spread: _Picture) -> _Parts:
        return _parts(light, alpha, NearColors(front, variety * spread[0]), NearColors(back, spread[1]), alpha_error)

    return Unmixed(*in_bands(parts, light, alpha, front.mean, back.mean, front.variance, back.variance))


def _parts(light: _Picture, alpha: _Picture, front: NearColors, back: NearColors, alpha_error: float) -> _Parts:
    """Alpha, foreground and background of rows of the picture."""
    share = alpha[..., None].astype(np.float32)
    soft = (share > 0) & (share < 1)
    front_variance = front.variance.mean(axis=-1, keepdims=True) + _NOISE
    back_variance = back.variance.mean(axis=-1, keepdims=True) + _NOISE
    first, foreground, background = share, front.mean, back.mean
    for _ in range(_ROUNDS):
        spread = share**2 * front_variance + (1 - share) ** 2 * back_variance + _NOISE
        measured = _measured(light, foreground, background, first, doubt=3 * spread / alpha_error**2)
        share = np.where(soft, measured, first)
        spread = share**2 * front_variance + (1 - share) ** 2 * back_variance + _NOISE
        lack = (light - share * front.mean - (1 - share) * back.mean) / spread
        foreground = np.clip(front.mean + share * front_variance * lack, 0, 1)
        background = np.clip(back.mean + (1 - share) * back_variance * lack, 0, 1)
    return _made_exact(light, share, foreground, background)


def _measured(
    light: NDArray[np.float32],
    foreground: NDArray[np.float32],
    background: NDArray[np.float32],
    first: NDArray[np.float32],
    *,
    doubt: NDArray[np.float32],
) -> NDArray[np.float32]:
    """Where the light lies between the two colours, drawn to `first` by `doubt`."""
    apart = foreground - background
    along = ((light - background) * apart).sum(axis=-1, keepdims=True)
    return np.clip((along + doubt * first) / ((apart**2).sum(axis=-1, keepdims=True) + doubt), 0, 1)


def _made_exact(
    light: NDArray[np.float32],
    share: NDArray[np.float32],
    foreground: NDArray[np.float32],
    background: NDArray[np.float32],
) -> _Parts:
    """The background takes what the mixture still lacks; nearly solid foreground takes the rest."""
    rest = (light - share * foreground) / np.maximum(1 - share, _LEAST_SHARE)
    behind = np.where(share < 1, np.clip(rest, 0, 1), background)
    own = (light - (1 - share) * behind) / np.maximum(share, _LEAST_SHARE)
    solid = _ramp(share, 0.5) * (share > 0)
    front = foreground + solid * (np.clip(own, 0, 1) - foreground)
    parts = (share[..., 0], front, behind)
    return tuple(np.asarray(part, np.float32) for part in parts)


def _ramp(value: NDArray[np.float32], low: float) -> NDArray[np.float32]:
    """0 up to `low`, rising to 1 at 1."""
    return np.asarray(np.clip((value - low) / (1 - low), 0, 1), np.float32)
