"""Points on many strips at fixed parameters, as one sparse matrix.

At given parameters a point of a rational patch is a weighted mean of its control points, whatever these are. So the
weights are worked out once, and every pose of a hairdo is one product with its control points; the triangles and the
texture coordinates stay. The same matrix, transposed, says which control points to move for a point of the surface.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import BSpline
from scipy.sparse import csr_array

from tress.model.knots import degree_of, domain_of
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class StripGrid:
    """Q points in rows and columns on S strips, and the triangles between them.

    `weights` (Q, N) sparse float64: of the control points in each point; rows add up to 1. `fraction` (Q, 2) float64:
    0 at the root to 1 at the tip, and 0 to 1 across, as shares of the parameters' domains. `strip` (Q,) int32 says
    whose point it is, `offsets` (S + 1,) where each strip begins. `triangles` (F, 3) int32, facing du × dv.
    """

    weights: csr_array
    fraction: Array
    strip: Array
    offsets: Array
    triangles: Array

    def points(self, control_points: Array) -> Array:
        """(Q, 3) float64 points on strips with these control points (N, 3); any other values (N, C) too."""
        return self.weights @ control_points


def strip_grid(strips: Sequence[Strip], *, pieces: tuple[int, int] | None = None, density: int = 1) -> StripGrid:
    """A grid over each strip: every span between knots in `pieces` along and across, by default as its degree; times
    `density`.

    About 20 µs a strip, where the strips have the same knots.
    """
    shared: dict[tuple[Any, ...], _Patch] = {}
    return _grid(strips, [_by_span(strip, pieces or strip.degrees, density, shared) for strip in strips])


def even_strip_grid(strips: Sequence[Strip], *, segments: Array, rows: Sequence[Array] = ()) -> StripGrid:
    """A grid over each strip with `segments` (S, 2) equal intervals of its domain along and across: what a budget of
    triangles allows it. With `rows` for each strip, (segments + 1,) rising from 0 to 1, it is divided there along.
    """
    shared: dict[tuple[Any, ...], _Patch] = {}
    counts = np.asarray(segments).tolist()
    places = rows or [np.linspace(0, 1, along + 1) for along, _ in counts]
    given = zip(strips, places, counts, strict=True)
    return _grid(strips, [_divided(strip, along, across, shared) for strip, along, (_, across) in given])


def _grid(strips: Sequence[Strip], patches: Sequence["_Patch"]) -> StripGrid:
    sizes = np.array([len(patch.fraction) for patch in patches], np.int64)
    offsets = np.concatenate([np.zeros(1, np.int64), np.cumsum(sizes)])
    triangles = [patch.triangles + start for patch, start in zip(patches, offsets[:-1], strict=True)]
    return StripGrid(
        weights=_joined_weights(strips, patches),
        fraction=np.concatenate([np.zeros((0, 2)), *(patch.fraction for patch in patches)]),
        strip=np.repeat(np.arange(len(patches), dtype=np.int32), sizes),
        offsets=offsets,
        triangles=np.concatenate([np.zeros((0, 3), np.int32), *triangles]).astype(np.int32),
    )


@dataclass(frozen=True, eq=False)
class _Patch:
    """What strips with the same knots share: B-splines (Q, 16) at their control points (Q, 16), for degree 3."""

    values: Array
    control: Array
    fraction: Array
    triangles: Array


def _by_span(strip: Strip, pieces: tuple[int, int], density: int, shared: dict[tuple[Any, ...], _Patch]) -> _Patch:
    key = (strip.knots_u.tobytes(), strip.knots_v.tobytes(), strip.weights.shape)
    if key not in shared:
        along, across = strip.weights.shape
        samples_u = _samples(strip.knots_u, along, _parameters_by_span(strip.knots_u, along, pieces[0] * density))
        parameters_v = _parameters_by_span(strip.knots_v, across, pieces[1] * density)
        shared[key] = _new_patch(samples_u, _samples(strip.knots_v, across, parameters_v), across)
    return shared[key]


def _divided(strip: Strip, rows: Array, pieces_v: int, shared: dict[tuple[Any, ...], _Patch]) -> _Patch:
    key = (strip.knots_u.tobytes(), strip.knots_v.tobytes(), strip.weights.shape, rows.tobytes(), pieces_v)
    if key not in shared:
        along, across = strip.weights.shape
        low, high = domain_of(strip.knots_u, count=along)
        parameters_u = np.clip(low * (1 - rows) + high * rows, low, high)
        parameters_v = np.linspace(*domain_of(strip.knots_v, count=across), pieces_v + 1)
        samples_u = _samples(strip.knots_u, along, parameters_u)
        shared[key] = _new_patch(samples_u, _samples(strip.knots_v, across, parameters_v), across)
    return shared[key]


@dataclass(frozen=True, eq=False)
class _Samples:
    """Parameters in one direction: their share of the domain, their B-splines (n, p + 1), the first control point."""

    fraction: Array
    values: Array
    first: Array


def _parameters_by_span(knots: Array, count: int, pieces: int) -> Array:
    breaks = np.unique(knots[degree_of(knots, count=count) : count + 1])
    cuts = np.arange(pieces) / pieces
    inner = breaks[:-1, None] * (1 - cuts) + breaks[1:, None] * cuts
    return np.clip(np.append(inner.ravel(), breaks[-1]), breaks[0], breaks[-1])


def _samples(knots: Array, count: int, parameters: Array) -> _Samples:
    degree = degree_of(knots, count=count)
    splines = BSpline.design_matrix(parameters, knots, degree)
    low, high = domain_of(knots, count=count)
    return _Samples(
        fraction=(parameters - low) / (high - low),
        values=splines.data.reshape(-1, degree + 1),
        first=splines.indices.reshape(-1, degree + 1)[:, 0].astype(np.int64),
    )


def _new_patch(along: _Samples, across: _Samples, columns: int) -> _Patch:
    rows_of = along.first[:, None] + np.arange(along.values.shape[1])
    columns_of = across.first[:, None] + np.arange(across.values.shape[1])
    control = rows_of[:, None, :, None] * columns + columns_of[None, :, None, :]
    values = along.values[:, None, :, None] * across.values[None, :, None, :]
    count = len(along.first) * len(across.first)
    fraction = np.stack(np.meshgrid(along.fraction, across.fraction, indexing="ij"), axis=-1)
    return _Patch(
        values=values.reshape(count, -1),
        control=control.reshape(count, -1),
        fraction=fraction.reshape(-1, 2),
        triangles=grid_triangles(len(along.first), len(across.first)),
    )


def grid_triangles(rows: int, columns: int) -> Array:
    """(2 (rows - 1) (columns - 1), 3) int64 triangles of a grid of points, row after row."""
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    below, right = corner + columns, corner + 1
    return np.stack([corner, below, below + 1, corner, below + 1, right], axis=1).reshape(-1, 3)


def _joined_weights(strips: Sequence[Strip], patches: Sequence[_Patch]) -> csr_array:
    """The rational weights of all patches, each in its own block."""
    data, indices, lengths, start = [], [], [], 0
    for strip, patch in zip(strips, patches, strict=True):
        own = strip.weights.ravel()[patch.control] * patch.values
        data.append((own / own.sum(axis=1, keepdims=True)).ravel())
        indices.append((patch.control + start).ravel())
        lengths.append(np.full(len(own), own.shape[1]))
        start += strip.weights.size
    if not data:
        return csr_array((0, 0))
    pointers = np.concatenate([[0], np.cumsum(np.concatenate(lengths))])
    return csr_array((np.concatenate(data), np.concatenate(indices), pointers), shape=(len(pointers) - 1, start))
