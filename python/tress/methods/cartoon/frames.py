"""Frames along key hairs: direction, normal, and what is across both."""

from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

_PLAIN = 0.05
"""Sine of the angle between normal and direction below which the normal says nothing."""


@dataclass(frozen=True, eq=False)
class Frames:
    """Unit vectors (n, p, 3), at right angles: `along` the hair D, `normal` N, `across` R = N x D."""

    along: Array
    normal: Array
    across: Array


def frames(points: Array, *, normals: Array) -> Frames:
    """Frames of n hairs from their `points` (n, p, 3) and the surface's `normals` (n, p, 3).

    D = CV_{n+1} - CV_n, at the tip that before it; N is the surface's normal, made square to D; R = N x D. Where the
    normal fails (along the hair, or zero) and where it turns over from one point to the next, the frame goes on from
    the point before by the least rotation. So the sides never change places, and no frame turns but with its surface.
    Source: Modelling and Animating Cartoon Hair, section 3, Hair Clump Geometry.
    """
    steps = np.diff(points, axis=1)
    along = _unit(np.concatenate([steps, steps[:, -1:]], axis=1))
    for index in range(1, along.shape[1]):
        short = np.linalg.norm(along[:, index], axis=-1) < 0.5
        along[short, index] = along[short, index - 1]
    flat = normals - np.einsum("npi,npi->np", normals, along)[..., None] * along
    said = np.linalg.norm(flat, axis=-1)
    normal = _unit(flat)
    normal[:, 0] = np.where((said[:, 0] > _PLAIN)[:, None], normal[:, 0], _first(normal, said, along))
    for index in range(1, along.shape[1]):
        carried = _carried(normal[:, index - 1], along[:, index - 1], along[:, index])
        agrees = np.einsum("ni,ni->n", normal[:, index], carried)
        own = normal[:, index] * np.where(agrees < 0, -1, 1)[:, None]
        normal[:, index] = np.where((said[:, index] > _PLAIN)[:, None], own, carried)
    return Frames(along, normal, np.cross(normal, along))


def _first(normal: Array, said: Array, along: Array) -> Array:
    """(n, 3) normals at roots whose own fail: any direction square to the hair, near the next one that is known."""
    known = np.argmax(said > _PLAIN, axis=1)
    hint = normal[np.arange(len(normal)), known]
    least = np.eye(3)[np.argmin(np.abs(along[:, 0]), axis=1)]
    flat = [wish - np.einsum("ni,ni->n", wish, along[:, 0])[:, None] * along[:, 0] for wish in (hint, least)]
    return _unit(np.where((np.linalg.norm(flat[0], axis=1) > _PLAIN)[:, None], *flat))


def _carried(normal: Array, before: Array, after: Array) -> Array:
    """Normals (n, 3), square to `before`, turned by the least rotation that takes that direction to `after`; where the
    hair turns straight back, about the normal itself."""
    cosine = np.einsum("ni,ni->n", before, after)[:, None]
    lean = np.einsum("ni,ni->n", normal, after)[:, None]
    return _unit(np.where(cosine > -0.999999, normal - lean / np.maximum(1 + cosine, 1e-9) * (before + after), normal))


def _unit(vectors: Array) -> Array:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.where(length > 1e-12, vectors / np.maximum(length, 1e-12), 0)
