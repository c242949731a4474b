"""The nearest point of a small mesh."""

import numpy as np
from numpy.typing import NDArray


def nearest_on_mesh(
    points: NDArray[np.float64], positions: NDArray[np.float64], triangles: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """For each of `points` (N, 3) the nearest triangle (N,) and barycentric coordinates (N, 3). Brute force, N x F
    work.
    """
    corners = positions[triangles]
    chosen, weights = np.empty(len(points), np.int64), np.empty((len(points), 3))
    for k, point in enumerate(points):
        candidate = nearest_on_triangles(point, corners)
        distance = np.linalg.norm(np.einsum("fk,fkd->fd", candidate, corners) - point, axis=1)
        chosen[k] = int(np.argmin(distance))
        weights[k] = candidate[chosen[k]]
    return chosen, weights


def nearest_on_triangles(point: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Barycentric coordinates (F, 3) of the point of each triangle (F, 3, 3) nearest to `point` (3,)."""
    inside = _in_plane(point, corners)
    best = np.where((inside >= 0).all(axis=1, keepdims=True), inside, np.nan)
    reach = np.where(np.isnan(best[:, 0]), np.inf, 0.0)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        edge = corners[:, b] - corners[:, a]
        t = np.clip(np.einsum("fd,fd->f", point - corners[:, a], edge) / (edge**2).sum(axis=1).clip(1e-30), 0, 1)
        distance = np.linalg.norm(corners[:, a] + t[:, None] * edge - point, axis=1)
        closer = distance < reach
        weights = np.zeros((len(corners), 3))
        weights[:, a], weights[:, b] = 1 - t, t
        best = np.where(closer[:, None], weights, best)
        reach = np.minimum(reach, distance)
    return best


def _in_plane(point: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    u, v, w = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], point - corners[:, 0]
    uu, uv, vv = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    wu, wv = (w * u).sum(1), (w * v).sum(1)
    det = (uu * vv - uv * uv).clip(1e-30)
    second, third = (vv * wu - uv * wv) / det, (uu * wv - uv * wu) / det
    return np.stack([1 - second - third, second, third], axis=1)
