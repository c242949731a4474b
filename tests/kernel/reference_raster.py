"""A second rasteriser: every sample against every primitive, NumPy, no tiles, no culling."""

from itertools import pairwise

import numpy as np

SAMPLES_X = np.array([0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15])
SAMPLES_Y = np.array([0, 8, 12, 4, 10, 2, 6, 14, 15, 7, 3, 11, 5, 13, 9, 1])


def sample_positions(width, height):
    """(H * W, 16, 2) float64: the samples of every pixel."""
    pattern = (np.stack([SAMPLES_X, SAMPLES_Y], axis=1) + 0.5) / 16
    corner = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1).reshape(-1, 1, 2)
    return corner + pattern


def primitive_of_samples(points, offsets, half_width, vertices, triangles, *, width, height):
    """(H * W, 16) int: the nearest opaque primitive; triangles count from 1,000,000; -1: none."""
    positions = sample_positions(width, height)
    depth = np.full(positions.shape[:2], np.inf)
    nearest = np.full(positions.shape[:2], -1)
    for i, (inside, z) in _all(points, offsets, half_width, vertices, triangles, positions):
        hit = inside & (z < depth)
        depth[hit], nearest[hit] = z[hit], i
    return nearest


def _all(points, offsets, half_width, vertices, triangles, positions):
    for i, corners in enumerate(triangles):
        yield 1_000_000 + i, _triangle(_snapped(vertices)[corners], positions)
    snapped = _snapped(points)
    for first, end in pairwise(offsets):
        for i in range(first, end - 1):
            yield i, _segment(snapped, i, first, end, half_width, positions)


def _snapped(points):
    points = np.array(points, float)
    points[:, :2] = np.round(points[:, :2] * 1024) / 1024
    return points


def _triangle(corners, positions):
    a, b, c = corners[:, :2]
    areas = [_cross(q - p, positions - p) for p, q in ((b, c), (c, a), (a, b))]
    total = _cross(b - a, c - a)
    if total == 0:
        return np.zeros(positions.shape[:2], bool), np.zeros(positions.shape[:2])
    weights = np.stack(areas, axis=-1) / total
    return (weights > 0).all(axis=-1), weights @ corners[:, 2]


def _segment(points, i, first, end, half_width, positions):
    a, b = points[i, :2], points[i + 1, :2]
    length = np.linalg.norm(b - a)
    if length == 0:
        return np.zeros(positions.shape[:2], bool), np.zeros(positions.shape[:2])
    along = (b - a) / length
    t = np.clip((positions - a) @ along / length, 0, 1)
    start = _mitre(points, i, first, end, along)
    stop = _mitre(points, i + 1, first, end, along)
    inside = np.abs(_cross(along, positions - a)) <= half_width[i] * (1 - t) + half_width[i + 1] * t
    inside &= ((positions - a) @ start >= 0) & ((positions - b) @ stop < 0)
    return inside, points[i, 2] * (1 - t) + points[i + 1, 2] * t


def _mitre(points, i, first, end, along):
    if not first < i < end - 1:
        return along
    before, after = points[i, :2] - points[i - 1, :2], points[i + 1, :2] - points[i, :2]
    if not before.any() or not after.any() or before @ after < 0:
        return along
    both = before / np.linalg.norm(before) + after / np.linalg.norm(after)
    return both / np.linalg.norm(both)


def _cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
