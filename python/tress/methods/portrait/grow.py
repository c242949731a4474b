"""Strands in the hair volume: a visible layer that re-covers the photograph pixel by pixel, and the body behind it.

Chai et al. 2012, section 3.3.2. Both are streamlines through one field (`tress.kernel.fields.trace`): the visible
ones start at every hair pixel that has no strand yet, follow the picture, and go on into the volume to their root
and tip; the others start at random voxels until `count` strands are there or the voxels are full.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.ndimage import map_coordinates

from tress.base.params import Params, param
from tress.base.report import Report
from tress.kernel import fields
from tress.methods.portrait.envelope import Head
from tress.methods.portrait.strand_colors import strand_colors
from tress.methods.portrait.volume import HairVolume

Array = np.ndarray[Any, Any]

DEEP_IN_HEAD = 0.001
"""Metres within the head from which a vertex counts as passing through it."""


@dataclass(frozen=True)
class GrowParams(Params):
    """Settings of the strands."""

    count: int = param(50000, low=100, high=1000000, doc="Most strands.")
    front_density: float = param(2.0, low=0.1, high=100.0, doc="Hidden strands before the head for one behind it.")
    visible_share: float = param(0.4, low=0.0, high=1.0, doc="Most of them that start at the visible surface.")
    voxel_cap: int = param(60, low=1, high=60000, doc="Most strands in a voxel.")
    pixel_cap: int = param(8, low=1, high=1000, doc="Most visible strands in a pixel.")
    sheet_depth: float = param(0.0025, low=0.0, high=0.02, unit="m", doc="How far behind the surface the photo steers.")
    visible_step_px: float = param(1.25, low=0.25, high=10.0, unit="px", doc="Distance of vertices of visible strands.")
    hidden_step: float = param(0.005, low=0.0005, high=0.02, unit="m", doc="Distance of vertices of hidden strands.")
    longest: float = param(0.6, low=0.01, high=3.0, unit="m", doc="Longest way from a seed to root or tip.")
    shortest: float = param(0.012, low=0.0, high=0.2, unit="m", doc="Shorter strands are dropped.")
    clearance: float = param(0.001, low=0.0, high=0.01, unit="m", doc="Distance kept from the head.")


@dataclass(frozen=True)
class GrownHair:
    """Strands in the view frame, root to tip: `points` (N, 3) float32 metres, `offsets` (S + 1,) int64, `color` (N,
    3) float32 linear, `alpha` (N,) float32 in [0, 1]. Per strand: `visible`, on the photograph's surface; `rooted`,
    the root meets the head.
    """

    points: Array
    offsets: Array
    color: Array
    alpha: Array
    visible: Array
    rooted: Array


def grow(
    hair: HairVolume,
    *,
    foreground: Array,
    alpha: Array,
    head: Head,
    params: GrowParams = GrowParams(),
    seed: int = 0,
    report: Report,
) -> GrownHair:
    """Up to `params.count` strands; `foreground` (H, W, 3) linear and `alpha` (H, W) are those of the matte."""
    random = np.random.default_rng(seed)
    matrix = head.xy_from_view
    field = fields.VoxelField(hair.direction, hair.head_distance, hair.origin, hair.voxel)
    sheet = fields.FrontSheet(hair.sheet, hair.flow.direction, matrix)
    step = params.visible_step_px / matrix[0, 0]
    most = int(params.visible_share * params.count)
    seen = fields.trace(
        _visible_seeds(hair.sheet, matrix, params, random),
        field=field,
        sheet=sheet,
        settings=_settings(params, step, params.pixel_cap, most),
    )
    rest = params.count - (len(seen.offsets) - 1)
    hidden = fields.trace(
        _hidden_seeds(hair, 3 * rest, params, random),
        field=field,
        sheet=sheet,
        settings=_settings(params, params.hidden_step, 0, rest),
        density=seen.density,
    )
    points = np.concatenate([seen.points, hidden.points]).astype(np.float32)
    offsets = np.concatenate([seen.offsets, hidden.offsets[1:] + len(seen.points)])
    visible = np.repeat([True, False], [len(seen.offsets) - 1, len(hidden.offsets) - 1])
    report.number("visible_strands", len(seen.offsets) - 1)
    report.number("hidden_strands", len(hidden.offsets) - 1)
    report.number("vertices", len(points))
    report.number("strands_through_head", _through_head(points, offsets, hair))
    color, opacity = strand_colors(points, offsets, visible, hair, foreground, alpha, matrix, random)
    return GrownHair(points, offsets, color, opacity, visible, np.concatenate([seen.rooted, hidden.rooted]))


def _through_head(points: Array, offsets: Array, hair: HairVolume) -> int:
    """Number of strands with a vertex more than a millimetre within the head."""
    place = hair.box.cells(points.astype(np.float64))[:, ::-1] - 0.5
    nearest = np.clip(np.rint(place).astype(np.int64), 0, np.array(hair.inside.shape) - 1)
    close = np.nonzero(hair.head_distance[tuple(nearest.T)] < hair.voxel)[0]
    within = close[map_coordinates(hair.head_distance, place[close].T, order=1, mode="nearest") < -DEEP_IN_HEAD]
    return len(np.unique(np.searchsorted(offsets, within, side="right")))


def _settings(params: GrowParams, step: float, pixel_cap: int, most: int) -> fields.TraceSettings:
    return fields.TraceSettings(
        step=step,
        min_length=params.shortest,
        sheet_depth=params.sheet_depth,
        min_cosine=0.5,
        inertia=0.2,
        voxel_cap=params.voxel_cap,
        pixel_cap=pixel_cap,
        clearance=params.clearance,
        most=most,
    )


def _visible_seeds(depth: Array, xy_from_view: Array, params: GrowParams, random: np.random.Generator) -> Array:
    """A seed in every hair pixel, in random order, a little behind the surface."""
    row, column = np.nonzero(np.isfinite(depth))
    order = random.permutation(len(row))
    row, column = row[order], column[order]
    x = (column + 0.5 - xy_from_view[0, 3]) / xy_from_view[0, 0]
    y = (row + 0.5 - xy_from_view[1, 3]) / xy_from_view[1, 1]
    z = depth[row, column] - random.uniform(0, 0.6 * params.sheet_depth, len(row))
    ways = np.full(len(row), params.longest)
    return np.stack([x, y, z, ways, ways], axis=1)


def _hidden_seeds(hair: HairVolume, count: int, params: GrowParams, random: np.random.Generator) -> Array:
    """Random points of the volume behind the visible surface, denser in its front half."""
    z = hair.box.z[:, None, None]
    inside = hair.inside & (z < np.where(np.isfinite(hair.front), hair.front - params.sheet_depth, np.inf))
    centres = hair.box.centres(inside)
    before = (z > hair.mid) & np.isfinite(hair.front)
    chance = np.cumsum(np.where(before[inside], params.front_density, 1.0))
    if len(centres) == 0:
        return np.zeros((0, 5))
    chosen = np.searchsorted(chance, random.uniform(0, chance[-1], count), side="right")
    points = centres[np.minimum(chosen, len(centres) - 1)] + hair.voxel * random.uniform(-0.5, 0.5, (count, 3))
    return np.concatenate([points, np.full((count, 2), params.longest)], axis=1)
