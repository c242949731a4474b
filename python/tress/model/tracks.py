"""Keyframes of many strips evaluated at once: flat arrays, four rows and four weights a track.

Whatever the interpolation, the value at a time is a weighted sum of four stored rows: two moments (linear, step), two
moments and their tangents (cubic Hermite), or four moments (cubic without tangents, whose slopes are differences of
values). So finding rows and weights costs a few operations on arrays of one number a track, and the control points are
gathered once, however many moments there are.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from tress.model.keyframes import Keyframes

Array = np.ndarray[Any, Any]

INTERPOLATIONS = ("linear", "cubic", "step")
LINEAR, CUBIC, STEP = range(3)


@dataclass(frozen=True)
class Track:
    """Keyframes for a net of (U, V) control points."""

    keyframes: "Keyframes"
    shape: tuple[int, int]


@dataclass(frozen=True, eq=False)
class FlatTracks:
    """T tracks. Moment k of track t is row `first[t] + k` of `times`, its P control points are the rows from
    `base[t] + k * size[t]` of `pool` (R, 3); its tangents lie as far from `tangent_base[t]` (-1: there are none)."""

    times: Array
    first: Array
    count: Array
    pool: Array
    base: Array
    size: Array
    tangent_base: Array
    interpolation: Array
    loop: Array


def flat_tracks(tracks: Sequence[Track]) -> FlatTracks:
    """The tracks in flat arrays, each stretched over its net."""
    rows: list[Array] = []
    base, tangent_base, total = [], [], 0
    for item in tracks:
        base.append(total)
        rows.append(stretched(item.keyframes.values, item.shape).reshape(-1, 3))
        total += len(rows[-1])
        tangents = item.keyframes.tangents
        tangent_base.append(-1 if tangents is None else total)
        if tangents is not None:
            rows.append(stretched(tangents, item.shape).reshape(-1, 3))
            total += len(rows[-1])
    count = np.array([len(item.keyframes.times) for item in tracks], np.int64)
    return FlatTracks(
        times=np.concatenate([item.keyframes.times for item in tracks]),
        first=np.cumsum(count) - count,
        count=count,
        pool=np.concatenate(rows),
        base=np.array(base, np.int64),
        size=np.array([item.shape[0] * item.shape[1] for item in tracks], np.int64),
        tangent_base=np.array(tangent_base, np.int64),
        interpolation=np.array([INTERPOLATIONS.index(item.keyframes.interpolation) for item in tracks], np.int64),
        loop=np.array([item.keyframes.loop for item in tracks], bool),
    )


def stretched(values: Array, shape: tuple[int, int]) -> Array:
    """(K, U, V, 3) values over a net of another `shape`: linear between neighbours, the corners on the corners."""
    for axis, wanted in ((1, shape[0]), (2, shape[1])):
        found = values.shape[axis]
        if found != wanted:
            place = np.linspace(0, found - 1, wanted)
            low = np.minimum(place.astype(np.int64), max(found - 2, 0))
            share = (place - low).reshape((-1,) + (1,) * (3 - axis))
            high = np.minimum(low + 1, found - 1)
            values = values.take(low, axis=axis) * (1 - share) + values.take(high, axis=axis) * share
    return values


def blended(tracks: FlatTracks, point: Array, track: Array, time: float) -> Array:
    """(N, 3) float64 values at `time`: control point `point` (N,) of `track` (N,)."""
    rows, weights = _rows_and_weights(tracks, time)
    result = np.zeros((len(point), 3))
    for row, weight in zip(rows, weights, strict=True):
        if weight.any():
            result += np.take(tracks.pool, row[track] + point, axis=0) * weight[track][:, None]
    return result


def _rows_and_weights(tracks: FlatTracks, time: float) -> tuple[Array, Array]:
    """The four first rows in the pool, and their weights, of every track: (4, T) each."""
    now = _local_time(tracks, time)
    owner = np.repeat(np.arange(len(tracks.count)), tracks.count)
    passed = np.add.reduceat((tracks.times <= now[owner]).astype(np.int64), tracks.first)
    moment = np.clip(passed - 1, 0, tracks.count - 1)
    start = np.minimum(moment, np.maximum(tracks.count - 2, 0))
    step = _step_after(tracks, start)
    share = np.clip((now - tracks.times[tracks.first + start]) / step, 0, 1)

    moments, weights = _neighbours(tracks, start), np.zeros((4, len(start)))
    weights[1:3] = 1 - share, share
    weights[1:3] = np.where(tracks.interpolation == STEP, [moment == start, moment > start], weights[1:3])
    smooth = (tracks.interpolation == CUBIC) & (tracks.count > 1)
    weights = np.where(smooth, _cubic_weights(tracks, moments, step, share), weights)
    rows = tracks.base + moments * tracks.size
    given = tracks.tangent_base >= 0
    tangent_rows = tracks.tangent_base + moments[1:3] * tracks.size
    rows[0], rows[3] = np.where(given, tangent_rows, rows[[0, 3]])
    return rows, weights


def _local_time(tracks: FlatTracks, time: float) -> Array:
    """The time within each track: between its first and its last moment."""
    begin, end = tracks.times[tracks.first], tracks.times[tracks.first + tracks.count - 1]
    span = np.where(tracks.loop, end - begin, 1.0)
    return np.where(tracks.loop, begin + np.mod(time - begin, span), np.clip(time, begin, end))


def _neighbours(tracks: FlatTracks, start: Array) -> Array:
    """(4, T) moments: before `start`, `start`, after it, and the one after that; across the seam of a loop."""
    last = tracks.count - 1
    before = np.where(start > 0, start - 1, np.where(tracks.loop, last - 1, start))
    after = np.minimum(start + 1, last)
    beyond = np.where(after < last, after + 1, np.where(tracks.loop, np.minimum(1, last), after))
    return np.stack([before, start, after, beyond])


def _step_after(tracks: FlatTracks, moment: Array) -> Array:
    """Seconds from a moment to the next one; 1 where there is none."""
    row = tracks.first + moment
    there = moment < tracks.count - 1
    return np.where(there, tracks.times[np.where(there, row + 1, row)] - tracks.times[row], 1.0)


def _cubic_weights(tracks: FlatTracks, moments: Array, step: Array, share: Array) -> Array:
    """(4, T) weights of cubic Hermite pieces: of the four moments, or of two moments between their tangents."""
    from_tangent = share * (1 - share) ** 2 * step
    to_tangent = share**2 * (share - 1) * step
    to_value = share**2 * (3 - 2 * share)
    given = np.stack([from_tangent, 1 - to_value, to_value, to_tangent])

    # A slope is back * (value - value before) + on * (value after - value).
    has_before, has_beyond = moments[0] != moments[1], moments[3] != moments[2]
    step_before = _step_after(tracks, moments[0])
    step_beyond = _step_after(tracks, np.where(moments[2] < tracks.count - 1, moments[2], 0))
    from_back = np.where(has_before, step / (step_before * (step_before + step)), 0.0)
    from_on = np.where(has_before, step_before / (step * (step_before + step)), 1 / step)
    to_back = np.where(has_beyond, step_beyond / (step * (step + step_beyond)), 1 / step)
    to_on = np.where(has_beyond, step / (step_beyond * (step + step_beyond)), 0.0)
    differences = np.stack(
        [
            -from_tangent * from_back,
            1 - to_value + from_tangent * (from_back - from_on) - to_tangent * to_back,
            to_value + from_tangent * from_on + to_tangent * (to_back - to_on),
            to_tangent * to_on,
        ]
    )
    return np.where(tracks.tangent_base >= 0, given, differences)
