"""How far the hair can reach: what the head and the outline of the hair in the photograph imply, before any strand.

Hair is a layer around the skull. Where its outline stands out from the head's, the gap *is* the layer's thickness
there; at the hairline the layer is thin. Between the two the thickness is harmonic, and the surface is where the
distance to the support equals it: at the outline the surface turns away smoothly by construction, and back and front
close. The support is the skull and all that lies straight below its hair-bearing part, since hair falls from the
skull and does not cling to the neck. Beside the face the layer's front edge hangs from the temples' hairline.

Limits: the camera's roll is taken for the direction of gravity; hair gathered behind the head (a ponytail) is not seen.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from scipy.ndimage import binary_dilation, gaussian_filter, maximum_filter

from tress.base.parallel import together
from tress.kernel import fields, geom
from tress.methods.portrait.box import Box, box_around
from tress.methods.portrait.hanging import hanging_edge
from tress.methods.portrait.resample_picture import columns_from_pixels
from tress.methods.portrait.scalp_layer import Skin, scalp_thickness, skin_of_head

Array = np.ndarray[Any, Any]

MARGIN = 0.012
"""Metres of air around the hair in the box."""
DEEPEST = 0.09
"""Metres of hair allowed behind the head."""
GRAZE = 0.003
"""Metres by which the layer exceeds the gap at the outline, so that the surface there is a thin edge, not a point."""
LEAST = 0.007
"""Metres of hair at least, where it is not seen."""
RESTING = 0.008
"""Metres between the skin and the surface of hair that lies on it."""
CROWN_RADIUS = 0.13
"""Metres: radius with which hair turns down behind its highest place."""
FALLS_FROM = 0.04
"""Metres of hair straight above a shoulder from which it goes on behind it: a lock that lies across it does not."""
FROM_NAPE = 0.02
"""Metres above the nape where hair that meets a shoulder goes on behind it."""
CROWN = 0.012
"""Metres below its top from which the front of the hair leaves the roundness of the crown."""
LEAVES = 4.0
"""Metres forwards for one downwards with which it does."""
OUTLINE_BLUR = 2.0
"""Columns over which the slope of the outline is taken."""


class Head(Protocol):
    """What is read of a fitted head; see `tress.head.fit.FittedHead`."""

    @property
    def positions_in_view(self) -> Array: ...
    @property
    def triangles(self) -> Array: ...
    @property
    def masks(self) -> Mapping[str, Array]: ...
    @property
    def xy_from_view(self) -> Array: ...
    @property
    def view_from_head(self) -> Array: ...


@dataclass(frozen=True)
class SolidHead:
    """The head in the box. `front`, `back` (R, C) metres, NaN beside it; `distance` (L, R, C) float32 metres to its
    surface, negative inside; `hairline` (C,): z of the temples' hairline; `nape`: y of the lowest scalp; `skin`.
    """

    front: Array
    back: Array
    distance: Array
    hairline: Array
    nape: float
    skin: Skin

    @property
    def seen(self) -> Array:
        """(R, C) bool: columns that the head covers."""
        return np.isfinite(self.front)


@dataclass(frozen=True)
class Envelope:
    """Per column (R, C): `hair` and `extended` (hair, or hidden hair behind head and body) bool; `front`, `mid`,
    `back` and `thickness` metres. `outline`: hair columns at the background; `bare`: those that show face or body.
    `dome`: metres behind `mid` that the roundness of the crown leaves to hair. Per voxel of the head's skin,
    `on_skin` (N,) metres of hair; per column (C,), `edge`: y where hidden hair ends.
    """

    box: Box
    head: SolidHead
    hair: Array
    extended: Array
    outline: Array
    front: Array
    mid: Array
    back: Array
    thickness: Array
    bare: Array
    dome: Array
    on_skin: Array
    edge: Array


def hair_envelope(hair: Array, solid: Array, *, head: Head, voxel: float) -> Envelope:
    """The envelope for a fitted head, from the hair's pixels and those of what may hide hair, (H, W) bool each."""
    box = hair_box(head.positions_in_view, hair, head.xy_from_view, size=voxel)
    body = solid_head(head.positions_in_view, head.triangles, head.masks["scalp"], head.view_from_head, box)
    return envelope(hair, solid, head=body, box=box, xy_from_view=head.xy_from_view)


def hair_box(head_points: Array, hair: Array, xy_from_view: Array, *, size: float) -> Box:
    """The box that holds the head (V, 3) and the hair pixels (H, W) bool, from behind the one to before the other."""
    rows, columns = np.nonzero(hair)
    x = (np.array([columns.min(), columns.max() + 1]) - xy_from_view[0, 3]) / xy_from_view[0, 0]
    y = (np.array([rows.max() + 1, rows.min()]) - xy_from_view[1, 3]) / xy_from_view[1, 1]
    low = np.minimum(head_points.min(axis=0), [x[0], y[0], np.inf]) - [MARGIN, MARGIN, DEEPEST]
    high = np.maximum(head_points.max(axis=0), [x[1], y[1], -np.inf]) + [MARGIN, MARGIN, 0.05]
    return box_around(low, high, size=size)


def solid_head(positions: Array, triangles: Array, scalp: Array, view_from_head: Array, box: Box) -> SolidHead:
    """The head mesh (V, 3), (F, 3) as depths and distances; `scalp` (V,) weights in [0, 1]."""
    depth = fields.mesh_depth(box.cells(positions) * [1, 1, 0] + positions * [0, 0, 1], triangles, shape=box.shape[1:])
    z = box.z[:, None, None]
    inside = (z >= depth.back) & (z <= depth.front)
    signed = (fields.distance(inside) - fields.distance(~inside)) * np.float32(box.size)
    close = np.abs(signed) < 1.6 * box.size
    skin, near = together(
        lambda: skin_of_head(inside, positions, scalp, box),
        lambda: geom.signed_distances(positions, triangles=triangles, queries=box.centres(close)),
    )
    signed[close] = near.distance
    bearing = positions[scalp > 0.5]
    return SolidHead(
        depth.front,
        depth.back,
        signed,
        _hairline(bearing, view_from_head, box),
        float(bearing[:, 1].min()),
        skin,
    )


def _hairline(scalp: Array, view_from_head: Array, box: Box) -> Array:
    """z of the foremost hair-bearing skin beside the forehead, left and right, blended over the middle."""
    side = scalp @ view_from_head[:3, 0]
    half = np.percentile(np.abs(side), 99)
    ends = [np.percentile(scalp[sign * side > 0.6 * half, 2], 95) for sign in (-1, 1)]
    return np.interp(box.x, [-0.5 * half, 0.5 * half], ends)


def envelope(hair: Array, solid: Array, *, head: SolidHead, box: Box, xy_from_view: Array) -> Envelope:
    """From the hair's pixels (H, W) bool, and the pixels (H, W) bool of what may hide hair (face, body)."""
    hair_here = columns_from_pixels(hair, box, xy_from_view) > 0.5
    bare = (columns_from_pixels(solid, box, xy_from_view) > 0.5) & ~hair_here
    hidden = bare | head.seen
    background = ~(hair_here | hidden)
    reach = _support_distance(head, box)
    gap = reach.min(axis=0)
    outline = np.logical_and(hair_here, binary_dilation(background))
    inner = np.logical_and(hair_here & ~outline, binary_dilation(hidden & ~hair_here))
    resting = np.maximum(_near_front(head) + RESTING, head.hairline)
    at_hairline = _at_depth(reach, resting, box)
    known = outline | inner
    thickness = _harmonic(np.where(inner, at_hairline, gap + GRAZE), hair_here, known)
    shell = _surface(reach, np.maximum(thickness, gap + GRAZE / 2), box, from_front=True)
    nearest = np.minimum(box.z[reach.argmin(axis=0)], 0.0)
    dome, ahead = _dome(hair_here | head.seen, nearest, box)
    hung = _with_curtain(np.minimum(shell, ahead), nearest, head, inner, hair_here, known, box)
    front = _smooth(hung, hair_here)
    front = np.fmax(front, head.front + 0.4 * RESTING)
    edge = hanging_edge(hair_here, nape=head.nape, middle=_middle(head, box), box=box)
    extended = _extended(hair_here, hidden, head, edge, box) | _falling(hair_here, bare, head, edge, box)
    behind = np.maximum(np.maximum(_harmonic(gap + GRAZE, extended, outline), gap + GRAZE / 2), LEAST)
    back = _surface(reach, behind, box, from_front=False)
    mid = np.clip(_harmonic(nearest, extended, outline), back, np.where(hair_here, front, np.inf))
    on_skin = scalp_thickness(
        head.skin, front=head.front, hair=hair_here, bare=bare, outline=outline, nearest=nearest, gap=gap, box=box
    )
    back = np.minimum(np.maximum(back, mid - dome), mid)
    return Envelope(box, head, hair_here, extended, outline, front, mid, back, behind, bare, dome, on_skin, edge)


def _dome(shown: Array, nearest: Array, box: Box) -> tuple[Array, Array]:
    """(R, C) metres: half the depth of a round crown at every height below the outline's top in its column, and the
    foremost depth that it leaves to hair close below that top; `nearest` (R, C): depth where the outline is touched.

    Where a surface of depth radius `CROWN_RADIUS` touches the outline it has turned away by √(2 radius × drop); the
    less, the steeper the outline is there, since the sides of a head are flat.
    """
    first = shown.argmax(axis=0)
    top = np.where(shown.any(axis=0), box.y[first], box.y[-1])
    top = np.maximum(top, gaussian_filter(top, OUTLINE_BLUR, mode="nearest"))
    slope = np.gradient(top, box.size)
    drop = np.maximum(top - box.y[:, None] + 0.5 * box.size, 0.0)
    half = np.sqrt(2 * CROWN_RADIUS * drop) * (1 + slope * slope)
    touched = np.take_along_axis(nearest, first[None], axis=0)
    return half, touched + half + np.maximum(drop - CROWN, 0.0) * LEAVES


def _middle(head: SolidHead, box: Box) -> float:
    """x of the middle of the neck at the nape."""
    row = int(np.abs(box.y - head.nape).argmin())
    seen = box.x[head.seen[row]]
    return float(seen.mean()) if len(seen) else 0.0


def _support_distance(head: SolidHead, box: Box) -> Array:
    """Metres to the head above the nape and to what lies straight below its hair-bearing part.

    Neck and shoulders carry no hair: it passes by them.
    """
    inside = np.less_equal(head.distance, 0)
    z, y = box.z[:, None, None], box.y[None, :, None]
    bearing = np.logical_and(inside, (z <= head.hairline) & (y > 0))
    below = np.logical_or.accumulate(bearing, axis=1)
    return fields.distance(np.logical_or(inside & (y >= min(head.nape, 0.0)), below)) * np.float32(box.size)


def _near_front(head: SolidHead) -> Array:
    """Front of the head in a column or the next ones; far behind where there is none."""
    return maximum_filter(np.where(head.seen, head.front, -1.0), size=3)


def _harmonic(values: Array, mask: Array, known: Array) -> Array:
    """Harmonic over `mask` with `values` where `known`; edges of the mask are natural."""
    weights = np.full(mask.shape, 1e-7)
    known = known & mask
    mean = values[known].mean() if known.any() else 0.008
    return fields.diffuse(np.where(known, values, mean), mask=mask, weights=weights, fixed=known).values


def _with_curtain(
    shell: Array, nearest: Array, head: SolidHead, inner: Array, hair: Array, known: Array, box: Box
) -> Array:
    """The shell, and beside the face hair that hangs from the temples' hairline with a rounded edge."""
    inward = np.clip(_harmonic(inner.astype(float), hair, known), 0, 1)
    curtain = nearest + (head.hairline - nearest) * np.cbrt(1 - (1 - inward) ** 3)
    crown = np.nanmax(np.where(head.seen, box.y[:, None], np.nan))
    share = np.clip((0.8 - box.y / crown) / 0.3, 0, 1)[:, None]
    share = share * share * (3 - 2 * share)
    return np.maximum(shell, curtain * share + shell * (1 - share))


def _smooth(values: Array, mask: Array) -> Array:
    """Gaussian mean over the mask by one and a half columns: the steps of the voxels go."""
    share = gaussian_filter(mask.astype(float), 1.5)
    return np.where(mask, gaussian_filter(np.where(mask, values, 0.0), 1.5) / np.maximum(share, 1e-6), values)


def _extended(hair: Array, hidden: Array, head: SolidHead, edge: Array, box: Box) -> Array:
    """Hair, the head above the nape, and above the `edge` (C,) what hides the middle of hair that hangs at a side."""
    hanging = np.logical_and(hair, box.y[:, None] < head.nape)
    left = np.logical_or.accumulate(hanging, axis=1)
    right = np.logical_or.accumulate(hanging[:, ::-1], axis=1)[:, ::-1]
    between = (left & right) | (head.seen & (left | right))
    above = box.y[:, None] >= edge
    return hair | (head.seen & (box.y >= head.nape)[:, None]) | (between & hidden & above)


def _falling(hair: Array, bare: Array, head: SolidHead, edge: Array, box: Box) -> Array:
    """Where hair goes on behind a shoulder: below hair that hangs, as far as body hides it, down to the `edge` (C,)."""
    hides = bare & ~head.seen & (box.y[:, None] >= edge)
    long = np.zeros(hair.shape, np.int64)
    for row in range(1, len(long)):
        long[row] = (long[row - 1] + 1) * hair[row]
    falling = np.logical_and(long * box.size > FALLS_FROM, box.y[:, None] < head.nape + FROM_NAPE)
    for row in range(1, len(falling)):
        falling[row] |= falling[row - 1] & hides[row]
    return falling & hides


def _at_depth(distance: Array, z: Array, box: Box) -> Array:
    """`distance` (L, R, C) at depth `z` (R, C), linear between layers."""
    place = np.clip((z - box.origin[2]) / box.size - 0.5, 0, box.layers - 1.001)
    layer = place.astype(int)
    share = place - layer
    low, high = (np.take_along_axis(distance, (layer + k)[None], axis=0)[0] for k in (0, 1))
    return low * (1 - share) + high * share


def _surface(distance: Array, level: Array, box: Box, *, from_front: bool) -> Array:
    """(R, C) metres: the first depth, seen from the front or the back, where `distance` falls to `level`.

    Where it never does: the depth of the least distance.
    """
    stack = distance[::-1] if from_front else distance
    within = stack <= level
    first = within.argmax(axis=0)
    near = np.take_along_axis(stack, first[None], axis=0)[0]
    far = np.take_along_axis(stack, np.maximum(first - 1, 0)[None], axis=0)[0]
    share = np.clip((level - near) / np.maximum(far - near, 1e-9), 0, 1) * (first > 0)
    steps = first - share
    z = box.z[-1] - box.size * steps if from_front else box.z[0] + box.size * steps
    return np.where(within.any(axis=0), z, box.z[distance.argmin(axis=0)])
