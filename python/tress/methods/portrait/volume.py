"""The body of hair: D_front, D_mid, D_back, and a direction in every voxel between them.

Chai et al. 2012, section 3.3.2. The front is the strands' depth; the back is pushed behind the head by the thickness
that the outline shows. Directions known from the photograph are turned into structure tensors (which know no forth
and back, so that hair parted to both sides does not cancel), diffused with their sense through the voxels, and laid
into the layers of the hair. Hidden hair has a weak wish of its own: down along the layer. Towards the tip strands
rise a little through the layers, so that followed to the root they dive to the scalp, upper hair covering lower hair.

Limits: what the photograph does not show follows gravity; a ponytail or a bun behind the head is not invented.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.ndimage import binary_dilation, gaussian_filter

from tress.base.parallel import together
from tress.base.params import Params, param
from tress.base.report import Report
from tress.kernel import fields
from tress.methods.portrait.behind_body import behind_head, behind_shoulders, over_bust
from tress.methods.portrait.box import Box
from tress.methods.portrait.depth import StrandDepths, Traced
from tress.methods.portrait.envelope import Envelope, Head
from tress.methods.portrait.flow import FlowParams, HairFlow, hair_flow
from tress.methods.portrait.resample_picture import columns_from_pixels, pixels_from_columns, spread
from tress.methods.portrait.scalp_layer import BEARING
from tress.methods.portrait.sweep import swept
from tress.methods.portrait.waves import LOCK, waves, waviness

Array = np.ndarray[Any, Any]

OVER_BUST = 0.012
"""Metres of hair at least that fall over the bust."""
THIN = 0.004
"""Metres of hair on the skin that the roundness of the crown leaves."""
OVER_SKIN = 0.015
"""Metres over bare skin that stay free of hair that does not hang there."""
SEEN = 0.010
"""Metres of hair behind what is seen that may lie over bare skin."""
BESIDE_HEAD = 2
"""Columns beside the head into which hair on its skin may reach."""
HANGING = 0.002
"""Metres below the nape from which hair counts as long."""
TRACED_SHARE = 1.5
"""Length of short hair for the length of the strands that can be followed in the photo, nine in ten of them shorter."""
SHORTEST = 0.018
"""Metres that short hair is long at least."""
THICK_TO_LONG = 5.0
"""Length of short hair for the thickness of its layer."""
WAVES_FROM = 0.012
"""Metres behind the visible surface from which hidden hair has waves of its own."""


@dataclass(frozen=True)
class VolumeParams(Params):
    """Settings of the hair volume."""

    picture_weight: float = param(
        4.0, low=0.0, high=100.0, doc="Weight of directions seen in the photograph against smoothness."
    )
    gravity_weight: float = param(0.02, low=0.0, high=10.0, doc="Weight of falling, where nothing is seen.")
    layer_share: float = param(0.8, low=0.0, high=1.0, doc="How far directions are turned into the layers.")
    rise: float = param(0.12, low=0.0, high=1.0, doc="Slope by which strands rise through the layers near the scalp.")
    thickest: float = param(0.035, low=0.005, high=0.1, unit="m", doc="Deepest hair that is filled.")
    seen_alpha: float = param(0.3, low=0.0, high=1.0, doc="Pixels with more hair than this get visible strands.")
    flow: FlowParams = field(default_factory=FlowParams)
    longest: float = param(0.6, low=0.01, high=3.0, unit="m", doc="Longest hair.")
    steepest: float = param(0.5, low=0.0, high=1.0, doc="Greatest slope by which short hair rises.")
    thinnest: float = param(0.010, low=0.002, high=0.05, unit="m", doc="Hair that is filled where the layer is thin.")


@dataclass(frozen=True)
class HairVolume:
    """Where hair is and which way it runs.

    Per column (R, C) float32 metres, NaN beside the hair: `front`, `mid`, `back`. Per voxel (L, R, C): `inside` bool;
    `direction` (…, 3) float32 unit, root to tip, zero outside; `head_distance` float32 metres, negative in the head.
    `origin` (3,) and `voxel` metres as in `Box`. Per pixel: `sheet` (H, W) float32, depth of the visible surface,
    NaN beside the hair, and `flow`, the direction in the picture. `lengths` (N,) float32: how long hidden hair is at
    the N voxels `inside`, metres; `nape`: y of the scalp's lower end.
    """

    origin: Array
    voxel: float
    front: Array
    mid: Array
    back: Array
    inside: Array
    direction: Array
    head_distance: Array
    sheet: Array
    flow: HairFlow
    lengths: Array
    nape: float

    @property
    def box(self) -> Box:
        """The voxels' place."""
        return Box(self.origin, self.voxel, *self.inside.shape)


def volume(
    depths: StrandDepths,
    *,
    traced: Traced,
    brightness: Array,
    alpha: Array,
    head: Head,
    params: VolumeParams = VolumeParams(),
    report: Report,
) -> HairVolume:
    """The volume, from the strands' depths and the orientation (`angle`, `confidence`) and matte (`alpha`) of the
    photo.
    """
    surface, matrix = depths.envelope, head.xy_from_view
    box, solid = surface.box, surface.head
    hair = alpha > params.seen_alpha

    def body() -> tuple[Array, Array, Array, Array]:
        front = _front(depths, traced, matrix)
        inside, depth_m = _filled(surface, front, params)
        return front, inside, *_layers(depth_m, solid.distance, inside)

    (front, inside, layer, normal), flow = together(
        body,
        lambda: hair_flow(brightness, hair=hair, crown_px=_crown(head), px_per_metre=matrix[0, 0], params=params.flow),
    )
    flat, trust = _column_directions(flow, surface, matrix)
    wish = swept(surface.head.skin, inside, ~_hangs_at(surface), backward=-head.view_from_head[:3, 2], box=box)
    vectors, weights = _data(inside, front, flat, trust, normal, wish, surface, params)
    found = fields.diffuse_axes(vectors, mask=inside, weights=weights)
    out = np.zeros((*box.shape, 3), np.float32)
    thickness = surface.on_skin[solid.skin.nearest[inside]]
    lengths = _lengths(thickness, inside, surface, _traced_length(traced, matrix[0, 0]), params)
    rise = np.clip(thickness / lengths, params.rise, params.steepest)
    axes = _waved(found.axes, inside, front, surface, waviness(flow, px_per_metre=matrix[0, 0]))
    out[inside] = _laid(axes, layer, normal, solid.distance[inside], rise, params)
    report.number("voxels", int(inside.sum()))
    report.number("diffusion_steps", found.iterations)
    report.number("diffusion_converged", found.converged)
    front_map, mid, back = _surfaces(surface, front, inside)
    sheet = pixels_from_columns(spread(front, surface.hair), box, matrix, shape=alpha.shape)
    sheet[~hair] = np.nan
    return HairVolume(
        box.origin,
        box.size,
        front_map,
        mid,
        back,
        inside,
        out,
        solid.distance,
        sheet,
        flow,
        lengths.astype(np.float32),
        solid.nape,
    )


def _lengths(thickness: Array, inside: Array, surface: Envelope, seen: float, params: VolumeParams) -> Array:
    """(N,) metres: how long hidden hair is at the voxels `inside`. Where hair hangs below the nape it ends at its edge;
    shorter hair is no longer than what is `seen`, metres, and the shorter the thinner it lies.
    """
    column = np.nonzero(inside)[2]
    short = np.clip(THICK_TO_LONG * thickness, SHORTEST, max(seen, SHORTEST))
    return np.minimum(np.where(_hangs_at(surface)[column], params.longest, short), params.longest)


def _traced_length(traced: Traced, px_per_metre: float) -> float:
    """Metres: how long the strands are that can be followed in the photo; infinite where there are none."""
    if len(traced.offsets) < 2:
        return np.inf
    steps = np.linalg.norm(np.diff(np.asarray(traced.points, np.float64), axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    ends = np.asarray(traced.offsets)
    lengths = along[ends[1:] - 1] - along[ends[:-1]]
    return float(TRACED_SHARE * np.percentile(lengths, 90) / px_per_metre)


def _crown(head: Head) -> Array:
    """(2,) px: where the highest scalp of the upright head is in the photo."""
    upright = head.positions_in_view @ head.view_from_head[:3, 1]
    top = head.positions_in_view[int(upright.argmax())]
    return head.xy_from_view[:2, :3] @ top + head.xy_from_view[:2, 3]


def _front(depths: StrandDepths, traced: Traced, xy_from_view: Array) -> Array:
    """(R, C) metres: the envelope, moved by what the strands' depths differ from it, diffused over the hair."""
    surface = depths.envelope
    box = surface.box
    if len(depths.z) == 0:
        return surface.front
    column = ((traced.points[:, 0] - xy_from_view[0, 3]) / xy_from_view[0, 0] - box.origin[0]) / box.size
    row = (box.origin[1] - (traced.points[:, 1] - xy_from_view[1, 3]) / xy_from_view[1, 1]) / box.size
    column, row = (np.clip(np.floor(v).astype(int), 0, n - 1) for v, n in ((column, box.columns), (row, box.rows)))
    count, total = np.zeros(surface.hair.shape), np.zeros(surface.hair.shape)
    np.add.at(count, (row, column), 1.0)
    np.add.at(total, (row, column), depths.z - surface.front[row, column])
    moved = fields.diffuse(total / np.maximum(count, 1), mask=surface.hair, weights=np.minimum(count / 8, 1.0) + 1e-4)
    return surface.front + moved.values


def _surfaces(surface: Envelope, front: Array, inside: Array) -> tuple[Array, Array, Array]:
    """Front, middle and back (R, C) float32 metres of the voxels of hair; NaN where there are none."""
    any_hair = inside.any(axis=0)
    back = np.where(any_hair, surface.box.z[inside.argmax(axis=0)] - 0.5 * surface.box.size, np.nan)
    mid = np.fmax(np.where(any_hair, surface.mid, np.nan), back)
    shown = np.where(surface.hair, np.fmax(front, mid), np.nan)
    return shown.astype(np.float32), mid.astype(np.float32), back.astype(np.float32)


def _filled(surface: Envelope, front: Array, params: VolumeParams) -> tuple[Array, Array]:
    """Voxels of hair, and metres from the outer surface inwards."""
    box, head = surface.box, surface.head
    z = box.z[:, None, None]
    shown = surface.hair & (z <= front + 0.5 * box.size)
    behind = z <= np.maximum(behind_head(head, box), behind_shoulders(surface, front))
    hangs = _hangs(surface)
    back = np.where(hangs, np.minimum(surface.back, over_bust(head, box) - OVER_BUST), surface.back)
    long = surface.extended & hangs
    between = (z >= back) & ((shown & ((z >= surface.mid) | ~head.seen)) | (long & behind & (shown | ~surface.hair)))
    round_crown = (z >= surface.mid - surface.dome) | ~surface.extended | (head.distance <= THIN)
    layer = _on_scalp(surface) & np.where(surface.bare, behind, shown | ~surface.hair) & round_crown
    between &= _growable(surface, front)
    body = between | layer | (head.distance <= 0)
    depth_m = fields.distance(~body) * np.float32(box.size)
    reach = np.clip(surface.thickness, params.thinnest, params.thickest)
    outside = head.distance > 0.3 * box.size
    return layer | (outside & between & (depth_m <= reach + box.size)), depth_m


def _growable(surface: Envelope, front: Array) -> Array:
    """(L, R, C) bool: not close over skin that bears no hair, where none hangs, but for hair that is seen."""
    head, box = surface.head, surface.box
    bare = (head.skin.bearing <= BEARING)[head.skin.nearest] & (head.distance < OVER_SKIN)
    z = box.z[:, None, None]
    seen = surface.hair & ((z > front - SEEN) | (z >= head.front))
    return ~bare | seen | _hangs_at(surface)


def _hangs_at(surface: Envelope) -> Array:
    """(C,) bool: columns where hidden hair hangs below the nape."""
    return surface.edge < surface.head.nape - HANGING


def _on_scalp(surface: Envelope) -> Array:
    """(L, R, C) bool: voxels in the layer of hair on the head's skin.

    Where the skull fills the outline, or sticks out of it, one voxel's layer clings to it.
    """
    skin = surface.head.skin
    thickness = surface.on_skin.astype(np.float32)[skin.nearest]
    near_head = binary_dilation(surface.head.seen, iterations=BESIDE_HEAD)
    reach = np.where(surface.hair | surface.head.seen, thickness, np.minimum(thickness, surface.box.size))
    within = np.abs(surface.head.distance) <= 0.5 * surface.box.size
    return (
        (thickness > 0)
        & (within | ((surface.head.distance > 0) & (surface.head.distance <= reach)))
        & (surface.hair | near_head)
    )


def _hangs(surface: Envelope) -> Array:
    """(R, C) bool: where hidden hair may be that does not lie on the scalp, since it is long and falls."""
    return _hangs_at(surface) & (surface.box.y[:, None] >= surface.edge)


def _layers(depth_m: Array, head_distance: Array, inside: Array) -> tuple[Array, Array]:
    """Of the N voxels `inside`: (N,) 0 at the scalp, 1 at the surface; and the unit normal outwards (N, 3), zero where
    unclear.
    """
    skin = np.maximum(head_distance, 0)
    layer = gaussian_filter(skin / np.maximum(skin + depth_m, 1e-6), 1.0)
    towards, down, right = (_slope(layer, inside, axis) for axis in range(3))
    slope = np.stack([right, -down, towards], axis=-1)
    length = np.linalg.norm(slope, axis=-1, keepdims=True)
    return layer[inside], np.where(length > 1e-4, slope / np.maximum(length, 1e-9), 0.0)


def _slope(values: Array, inside: Array, axis: int) -> Array:
    """(N,): central difference along an axis, in voxels, at the N voxels `inside`."""
    place = list(np.nonzero(inside))
    last = values.shape[axis] - 1
    before, after = np.maximum(place[axis] - 1, 0), np.minimum(place[axis] + 1, last)
    low, high = (values[tuple(place[:axis] + [at] + place[axis + 1 :])] for at in (before, after))
    return (high - low) / np.maximum(after - before, 1)


def _column_directions(flow: HairFlow, surface: Envelope, xy_from_view: Array) -> tuple[Array, Array]:
    """Mean direction (R, C, 2), y up, of each column's pixels, by double angle and by sense; its trust (R, C)."""
    x, y, known = flow.direction[..., 0], flow.direction[..., 1], flow.trust
    double = np.stack([known * (x * x - y * y), known * 2 * x * y, known * x, known * y, known], axis=-1)
    mean = np.concatenate(
        [
            columns_from_pixels(double[..., :3], surface.box, xy_from_view),
            columns_from_pixels(double[..., 3:], surface.box, xy_from_view),
        ],
        axis=-1,
    )
    angle = np.arctan2(mean[..., 1], mean[..., 0]) / 2
    flat = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    sense = np.sign((flat * mean[..., 2:4]).sum(axis=-1))
    flat *= np.where(sense == 0, 1, sense)[..., None] * [1, -1]
    return flat, np.hypot(mean[..., 0], mean[..., 1]) * surface.hair


def _data(
    inside: Array,
    front: Array,
    flat: Array,
    trust: Array,
    normal: Array,
    wish: Array,
    surface: Envelope,
    params: VolumeParams,
) -> tuple[Array, Array]:
    """Directions (N, 3) and weights (N,) of what is seen and of the `wish` (N, 3), at the N voxels `inside`."""
    box = surface.box
    falling = wish - (normal * wish).sum(axis=1)[:, None] * normal
    length = np.linalg.norm(falling, axis=-1)
    weights = params.gravity_weight * length
    vectors = falling / np.maximum(length, 1e-9)[:, None]
    row_slope, column_slope = np.gradient(np.where(surface.hair, front, np.nan), box.size)
    rise = np.nan_to_num(column_slope) * flat[..., 0] - np.nan_to_num(row_slope) * flat[..., 1]
    seen = np.concatenate([flat, np.clip(rise, -3, 3)[..., None]], axis=-1)
    seen /= np.linalg.norm(seen, axis=-1, keepdims=True)
    layer, row, column = np.nonzero(inside)
    near = (np.abs(box.z[layer] - (front[row, column] - 0.5 * box.size)) <= 1.1 * box.size) & surface.hair[row, column]
    vectors[near] = seen[row[near], column[near]]
    weights[near] = params.picture_weight * trust[row[near], column[near]] + 1e-3
    return vectors, weights


def _waved(axes: Array, inside: Array, front: Array, surface: Envelope, amount: float) -> Array:
    """Axes (N, 3) of the voxels `inside`, turned by waves of `amount` radians; the less the nearer what is seen."""
    box = surface.box
    layer, row, column = np.nonzero(inside)
    behind = np.where(surface.hair, front, np.inf)[row, column] - box.z[layer]
    share = amount * np.clip(behind / WAVES_FROM, 0, 1)
    places = np.stack([column, row, layer], axis=1) + 0.5
    return axes + share[:, None] * waves(places, shape=box.shape, lock=LOCK / box.size, seed=0)


def _laid(axes: Array, layer: Array, normal: Array, head_distance: Array, rise: Array, params: VolumeParams) -> Array:
    """Axes (N, 3) turned into the layers, rising where the scalp is near; unit."""
    along = (axes * normal).sum(axis=-1, keepdims=True)
    laid = axes - params.layer_share * along * normal
    close = np.clip(1.5 - head_distance / 0.03, 0, 1)
    laid = laid / np.maximum(np.linalg.norm(laid, axis=-1, keepdims=True), 1e-9)
    laid = laid + (rise * close * (1 - layer))[:, None] * normal
    return laid / np.maximum(np.linalg.norm(laid, axis=-1, keepdims=True), 1e-9)
