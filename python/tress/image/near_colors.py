"""What the nearest known pixels look like: their mean colour and its variance, at every pixel of a picture."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

_LEAST_SIDE = 3
_ENOUGH = 0.1
"""Mean weight of a window from which on its own colours are taken and none from farther away."""


@dataclass(frozen=True)
class NearColors:
    """`mean` (H, W, 3) float32 and `variance` (H, W, 3) float32 of the known colours around every pixel."""

    mean: NDArray[np.float32]
    variance: NDArray[np.float32]


def near_colors(image: NDArray[np.float32], *, weight: NDArray[np.float32]) -> NearColors:
    """Mean and variance of the colours of `image` (H, W, 3) around every pixel, by `weight` (H, W) in [0, 1].

    Weighted moments are gathered in a pyramid and given back from coarse to fine: a window with little known in it
    takes after the larger one around it, so known colours reach as far as they must, and where they are dense the
    window is small (some 8 pixels). Without any weight, zeros. Linear in the pixels: about 30 ms for 500 x 500. Source
    of the idea: Gortler et al. 1996, pull-push.
    """
    moments = np.dstack([image, image * image, np.ones(weight.shape, np.float32)]) * weight[..., None]
    levels = [_smaller(_smaller(moments))]
    while min(levels[-1].shape[:2]) > _LEAST_SIDE:
        levels.append(_smaller(levels[-1]))
    total = levels[-1].mean(axis=(0, 1), keepdims=True)
    filled = np.broadcast_to(total[..., :6] / np.maximum(total[..., 6:], 1e-12), (*levels[-1].shape[:2], 6))
    for level in reversed(levels):
        share = np.minimum(level[..., 6:] / _ENOUGH, 1)
        own = level[..., :6] / np.maximum(level[..., 6:], 1e-12)
        filled = own * share + _at_size(filled, level.shape) * (1 - share)
    filled = _at_size(filled, weight.shape)
    mean = filled[..., :3]
    return NearColors(mean, np.maximum(filled[..., 3:] - mean * mean, 0))


def _smaller(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """Half the size; OpenCV filters four channels at once at most."""
    parts = np.split(values, [4], axis=2)
    return np.asarray(np.dstack([cv2.pyrDown(np.ascontiguousarray(part)) for part in parts]), np.float32)


def _at_size(values: NDArray[np.floating], shape: tuple[int, ...]) -> NDArray[np.float32]:
    size = (shape[1], shape[0])
    parts = np.split(np.asarray(values, np.float32), [3], axis=2)
    sized = [cv2.resize(np.ascontiguousarray(part), size, interpolation=cv2.INTER_LINEAR) for part in parts]
    return np.asarray(np.dstack(sized), np.float32)
