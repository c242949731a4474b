"""The shape model: random heads brought into one pose and size, then area-weighted principal components."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class ShapeModel:
    """`mean` (V, 3) metres; `components` (K, V, 3) metres for one standard deviation; `variance` (K,) explained."""

    mean: NDArray[np.float64]
    components: NDArray[np.float64]
    variance: NDArray[np.float64]


def vertex_areas(positions: NDArray[np.float64], triangles: NDArray[np.int64]) -> NDArray[np.float64]:
    """A third of the area of the triangles around each vertex (V,), square metres."""
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
    return np.bincount(triangles.ravel(), weights=np.repeat(area, 3), minlength=len(positions))


def aligned(heads: NDArray[np.float32], weight: NDArray[np.float64], *, rounds: int = 3) -> NDArray[np.float32]:
    """Heads (N, V, 3) moved, turned and scaled onto their mean, vertices counted by `weight` (V,); the mean keeps its
    size.
    """
    share = (weight / weight.sum()).astype(np.float32)
    heads = heads - np.einsum("nvd,v->nd", heads, share)[:, None]
    size = np.sqrt(np.einsum("nvd,nvd,v->n", heads, heads, share, optimize=True))
    heads = heads * (size.mean() / size)[:, None, None]
    for _ in range(rounds):
        mean = heads.mean(axis=0)
        u, _, vt = np.linalg.svd(np.einsum("nvi,vj,v->nij", heads, mean, share, optimize=True))
        heads = heads @ (u @ vt).astype(np.float32)
    return heads


def principal_components(heads: NDArray[np.float32], weight: NDArray[np.float64], *, count: int) -> ShapeModel:
    """The `count` directions of largest weighted variance of aligned heads (N, V, 3). Signs fixed: largest entry
    positive.
    """
    mean = heads.mean(axis=0, dtype=np.float64)
    root = np.sqrt(weight / weight.sum())
    flat = ((heads - mean) * root[:, None]).reshape(len(heads), -1).astype(np.float64)
    values, vectors = np.linalg.eigh(flat @ flat.T)
    order = np.argsort(-values)[:count]
    scores = vectors[:, order] * np.sqrt(len(heads))
    scores *= np.sign(scores[np.argmax(np.abs(scores), axis=0), np.arange(count)])
    difference = (heads - mean).reshape(len(heads), -1)
    components = (scores.T / len(heads)) @ difference
    return ShapeModel(mean, components.reshape(count, -1, 3), values[order] / values.clip(min=0).sum())
