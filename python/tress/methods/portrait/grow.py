"""Strands in the hair volume: a visible layer that re-covers the photograph pixel by pixel, and the body behind it.

Chai et al. 2012, section 3.3.2. Both are streamlines through one field (`tress.kernel.fields.trace`): the visible
ones start at every hair pixel that has no strand yet, follow the picture, and go on into the volume to their root
and tip; the others start at random voxels until `count` strands are there or the voxels are full.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from tress.base.params import Params, param
from tress.base.report import Report
from tress.kernel import fields
from tress.methods.portrait.envelope import Head
from tress.methods.portrait.inside_outline import inside_outline
from tress.methods.portrait.off_bare_skin import off_bare_skin
from tress.methods.portrait.strand_colors import strand_colors
from tress.methods.portrait.volume import HairVolume

Array = np.ndarray[Any, Any]

DEEP_IN_HEAD = 0.001
"""Metres within the head from which a vertex counts as passing through it."""

ON_SKIN = 0.004
"""Metres from the head within which hidden hair lies on the skin."""
AT_BACK = 2.0
"""Voxels that the back of the hair is thick."""
BACK_DENSITY = 4.0
"""Hidden strands that start there for one within."""
UNEVEN = 0.35
"""Share by which short hair is shorter than its neighbours at most."""
MOST_CUT = 0.35
"""Most of a hanging strand that is cut off so that tips differ."""


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
    hidden_step: float = param(0.007, low=0.0005, high=0.02, unit="m", doc="Distance of vertices of hidden strands.")
    longest: float = param(0.6, low=0.01, high=3.0, unit="m", doc="Longest way from a seed to root or tip.")
    shortest: float = param(0.006, low=0.0, high=0.2, unit="m", doc="Shorter strands are dropped.")
    shortest_visible: float = param(
        0.002, low=0.0, high=0.2, unit="m", doc="The same for strands on the photo's surface, down to its bumps."
    )
    ragged: float = param(0.02, low=0.0, high=0.2, unit="m", doc="How much the tips of hanging hair differ, mostly.")
    clearance: float = param(0.001, low=0.0, high=0.01, unit="m", doc="Distance kept from the head.")


@dataclass(frozen=True)
class GrownHair:
    """Strands in the view frame, root to tip: `points` (N, 3) float32 metres, `offsets` (S + 1,) int64, `color` (N,
    3) float32 linear, `alpha` (N,) float32 in [0, 1]. Per strand: `visible`, on the photograph's surface; `rooted`,
    the root meets the head. Per point: `on_skin`, hidden and close to the head; `shown`, with the
    photograph's own colour.
    """

    points: Array
    offsets: Array
    color: Array
    alpha: Array
    visible: Array
    rooted: Array
    on_skin: Array
    shown: Array


def grow(
    hair: HairVolume,
    *,
    foreground: Array,
    alpha: Array,
    before: Array,
    skin: Array,
    head: Head,
    params: GrowParams = GrowParams(),
    seed: int = 0,
    report: Report,
) -> GrownHair:
    """Up to `params.count` strands; `foreground` (H, W, 3) linear and `alpha` (H, W) are those of the matte.

    `before` (H, W) bool says which pixels hide what is behind; hidden strands stay behind them (`inside_outline`),
    and off the bare `skin` (H, W) bool (`off_bare_skin`).
    """
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
        settings=replace(
            _settings(params, step, params.pixel_cap, most), min_length=min(params.shortest, params.shortest_visible)
        ),
    )
    hidden = off_bare_skin(_hidden(hair, field, sheet, seen, params, random), skin=skin, head=head)
    hidden = replace(
        hidden,
        points=inside_outline(
            hidden.points, solid=before, xy_from_view=matrix, head_distance=hair.head_distance, box=hair.box
        ),
    )
    points = np.concatenate([seen.points, hidden.points]).astype(np.float32)
    offsets = np.concatenate([seen.offsets, hidden.offsets[1:] + len(seen.points)])
    visible = np.repeat([True, False], [len(seen.offsets) - 1, len(hidden.offsets) - 1])
    distance = fields.sample(hair.head_distance, places=hair.box.cells(points))
    report.number("visible_strands", len(seen.offsets) - 1)
    report.number("hidden_strands", len(hidden.offsets) - 1)
    report.number("vertices", len(points))
    through = np.searchsorted(offsets, np.flatnonzero(distance < -DEEP_IN_HEAD), side="right")
    report.number("strands_through_head", len(np.unique(through)))
    color, opacity, shown = strand_colors(points, offsets, visible, hair, foreground, alpha, before, matrix, random)
    on_skin = np.repeat(~visible, np.diff(offsets)) & (distance < ON_SKIN)
    rooted = np.concatenate([seen.rooted, hidden.rooted])
    return GrownHair(points, offsets, color, opacity, visible, rooted, on_skin, shown)


def _hidden(
    hair: HairVolume,
    field: fields.VoxelField,
    sheet: fields.FrontSheet,
    seen: fields.Traced,
    params: GrowParams,
    random: np.random.Generator,
) -> fields.Traced:
    """Strands of the body of hair behind those `seen`, with tips of different lengths."""
    rest = params.count - (len(seen.offsets) - 1)
    typical = float(np.median(hair.lengths)) if len(hair.lengths) else params.longest
    step = min(params.hidden_step, typical / 6)
    found = fields.trace(
        _hidden_seeds(hair, 3 * rest, params, random),
        field=field,
        sheet=sheet,
        settings=_settings(params, step, 0, rest),
        density=seen.density,
    )
    return _ragged(found, hair.nape, step, params, random)


def _ragged(
    found: fields.Traced, nape: float, step: float, params: GrowParams, random: np.random.Generator
) -> fields.Traced:
    """The strands, those that hang to the nape or lower cut short at random: most a little, few by much."""
    count = np.diff(found.offsets)
    hangs = found.points[found.offsets[1:] - 1, 1] < nape + params.ragged
    cut = np.minimum(random.exponential(params.ragged, len(count)), MOST_CUT * step * count) / step
    kept = np.where(hangs, np.maximum(count - np.rint(cut).astype(np.int64), np.minimum(count, 3)), count)
    within = np.arange(len(found.points)) - np.repeat(found.offsets[:-1], count) < np.repeat(kept, count)
    offsets = np.concatenate([[0], np.cumsum(kept)])
    return replace(found, points=found.points[within], offsets=offsets)


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
    """Random points of the volume behind the visible surface, denser in its front half and at its back.

    Strands from them are as long as hair is there; short ones start anywhere along their length.
    """
    z = hair.box.z[:, None, None]
    inside = hair.inside & (z < np.where(np.isfinite(hair.front), hair.front - params.sheet_depth, np.inf))
    centres = hair.box.centres(inside)
    before = (z > hair.mid) & np.isfinite(hair.front)
    at_back = z <= hair.back + AT_BACK * hair.voxel
    density = np.where(before, params.front_density, np.where(at_back, BACK_DENSITY, 1.0))
    chance = np.cumsum(density[inside])
    if len(centres) == 0:
        return np.zeros((0, 5))
    chosen = np.searchsorted(chance, random.uniform(0, chance[-1], count), side="right")
    chosen = np.minimum(chosen, len(centres) - 1)
    points = centres[chosen] + hair.voxel * random.uniform(-0.5, 0.5, (count, 3))
    length = np.minimum(hair.lengths[inside[hair.inside]], params.longest)[chosen]
    length = length * random.uniform(1 - UNEVEN, 1, count)
    ends = length >= (1 - UNEVEN) * params.longest  # where hair hangs, the volume ends it
    ahead = np.where(ends, params.longest, length * random.uniform(0, 1, count))
    back = np.where(ends, params.longest, length - ahead)
    return np.concatenate([points, ahead[:, None], back[:, None]], axis=1)
