"""Strips as chains of particles, and the way back."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.spatial import KDTree

from tress.dynamics.params import HairParams
from tress.kernel.dynamics import Chains
from tress.model.strip_set import StripSet

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class StripChains:
    """A chain for each strip, through the middles of its rows of control points.

    `row` (N,) int64: the particle of every control point; `offsets` (S + 1,) those of the chains' particles.
    """

    row: Array
    offsets: Array

    def middles(self, points: Array) -> Array:
        """(R, 3) particles of control points (N, 3)."""
        size = np.bincount(self.row)
        return np.stack([np.bincount(self.row, weights=points[:, axis]) for axis in range(3)], axis=1) / size[:, None]

    def widened(self, particles: Array, *, goal: Array) -> Array:
        """(N, 3) control points of moved particles (R, 3): every row as it is in the `goal` (N, 3), carried along and
        turned by the least rotation that the chain has turned by there."""
        before, after = _directions(self.middles(goal), self.offsets), _directions(particles, self.offsets)
        away = goal - self.middles(goal)[self.row]
        return particles[self.row] + _turned(away, before[self.row], after[self.row])


def strip_chains(strips: StripSet) -> StripChains:
    """The chains of a set of strips."""
    lengths, widths = strips.shapes.T
    first = np.concatenate([[0], np.cumsum(lengths)])
    row = [
        first[index] + np.repeat(np.arange(length), width)
        for index, (length, width) in enumerate(zip(lengths, widths, strict=True))
    ]
    return StripChains(np.concatenate([np.zeros(0, np.int64), *row]), first.astype(np.int64))


def particles_of(goal: Array, *, offsets: Array, params: HairParams, goal_weight: Array | None = None) -> Chains:
    """Masses by the lengths beside every particle of `goal` (R, 3), goal weights from root to tip, and links."""
    ends = np.linalg.norm(np.diff(goal, axis=0), axis=1)
    ends[offsets[1:-1] - 1] = 0
    beside = 0.5 * (np.concatenate([[0], ends]) + np.concatenate([ends, [0]]))
    place = np.arange(len(goal)) - np.repeat(offsets[:-1], np.diff(offsets))
    part = place / np.repeat(np.maximum(np.diff(offsets) - 1, 1), np.diff(offsets))
    weight = params.root_goal + part * (params.tip_goal - params.root_goal) if goal_weight is None else goal_weight
    return Chains(
        offsets=offsets,
        mass=params.density * np.maximum(beside, 1e-4),
        goal_weight=np.where(place < params.held, 1.0, weight),
        links=_links(goal, place, params.link_distance),
    )


def _links(goal: Array, place: Array, distance: float) -> Array:
    """Pairs (L, 2) of the same place along different chains that are near, nearest chains only."""
    if distance <= 0:
        return np.zeros((0, 2), np.int64)
    pairs = []
    for step in range(int(place.max(initial=0)) + 1):
        own = np.flatnonzero(place == step)
        found = KDTree(goal[own]).query_pairs(distance, output_type="ndarray")
        pairs.append(own[found])
    joined = np.concatenate([np.zeros((0, 2), np.int64), *pairs])
    return joined[np.lexsort(joined.T[::-1])]


def _directions(points: Array, offsets: Array) -> Array:
    """(R, 3) unit directions of chains at their particles."""
    along = np.zeros_like(points)
    for start, end in pairwise(offsets):
        if end - start > 1:
            along[start:end] = np.gradient(points[start:end], axis=0)
    length = np.linalg.norm(along, axis=1, keepdims=True)
    return np.where(length > 1e-12, along / np.maximum(length, 1e-12), [0.0, 1.0, 0.0])


def _turned(vectors: Array, before: Array, after: Array) -> Array:
    """Vectors (N, 3) turned by the least rotations that take unit `before` to unit `after`; half a turn goes about any
    axis, always the same."""
    cosine = np.einsum("ni,ni->n", before, after)[:, None]
    axis = np.cross(before, after)
    along = np.einsum("ni,ni->n", axis, vectors)[:, None]
    turned = cosine * vectors + np.cross(axis, vectors) + axis * along / np.maximum(1 + cosine, 1e-9)
    return np.where(cosine > -0.999999, turned, -vectors)
