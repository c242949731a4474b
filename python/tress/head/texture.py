"""The head's texture out of the photograph.

Two layers. Below lies a smooth colour of the skin all over the head (`skin_field`): the local mean of the photograph
where it surely shows skin, spread over the surface towards the median of the skin, and tinted on the scalp. On top
lies the photograph where a place faces the camera, is not behind another part of the head, and is face, or is well
inside the bare skin and of its colour; and where that is not so, the photograph of the mirrored place, multiplied by
the ratio of the two smooth colours, which takes the light of its side away and puts the right one on. What is on top
fades into what is below, which is already of its colour, so no edge shows, and no pixel of background, clothes or hair
is painted on.

Limits: the photograph's light stays in the texture; the completed skin is smooth; ears are of the smooth colour alone,
since they lie too inexactly on the photographed ones.
"""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from tress.head.face_places import face_places
from tress.head.fit import FittedHead
from tress.head.seen import seen_by_camera
from tress.head.skin_field import skin_field
from tress.head.skin_model import skin_model
from tress.head.skin_seen import SkinSeen, head_cells, skin_seen
from tress.head.statistical import StatisticalHead, load_statistical_head
from tress.head.texels import texels

ENOUGH = 0.6
"""Weight of the photograph from which the mirror image adds nothing."""
GREATEST_GAIN = 2.0
"""Between the brightness of one side of the head and of the other."""
SCALP_TINT = 0.4
"""How much of the hair's colour the skin of the scalp takes."""
ROOTS_TINT = 0.8
"""How much of it the skin takes where roots stand close."""
DEFAULT_SKIN = np.array([0.72, 0.55, 0.47], np.float32)
"""sRGB of the skin where the photograph shows none."""
MOUTH_COLOR = np.array([0.25, 0.10, 0.10], np.float32)
"""sRGB of the mouth's inside."""


def head_texture(
    image: NDArray[np.uint8],
    *,
    fitted: FittedHead,
    skin: NDArray[np.floating] | None = None,
    scalp_color: NDArray[np.floating] | None = None,
    scalp_cover: NDArray[np.floating] | None = None,
    size: int = 1024,
    head: StatisticalHead | None = None,
) -> NDArray[np.uint8]:
    """The texture (size, size, 3) uint8 sRGB for `fitted.corner_uv`, row 0 on top (v up), from `image` (H, W, 3) uint8
    sRGB.

    `skin` (H, W) in [0, 1] says where the photograph shows bare skin, so that no hair is painted on the head; without
    it the colour decides. `scalp_color` (3,) sRGB in [0, 1] tints the scalp, as hair roots do, where `scalp_cover` (V,)
    in [0, 1] says how closely they stand; without it all of the scalp, less. About 0.2 s.
    """
    head = head or load_statistical_head()
    layout = _layout(head, size)
    xy = fitted.project(fitted.positions_in_view)
    seen = seen_by_camera(fitted, head=head) * face_places(head).painted
    skin_at = _skin_at(image, skin, fitted, seen, head)
    if skin_at is None:
        return np.broadcast_to(np.rint(DEFAULT_SKIN * 255), (size, size, 3)).astype(np.uint8)
    field = _field(skin_at, xy, seen, head)
    gain = np.clip(field / np.maximum(field[head.mirror], 1e-3), 1 / GREATEST_GAIN, GREATEST_GAIN)
    likely = _remapped(skin_at.bare * skin_at.likely, skin_at.cells(xy))
    place = np.column_stack([xy, seen, face_places(head).any_color(likely, seen=seen)])
    own = _photographed(image, skin_at, layout.at(place))
    other = _photographed(image, skin_at, layout.at(place[head.mirror]), before=own)
    sheet = layout.at(_tinted(field, head, scalp_color, scalp_cover))
    _paint(sheet, own, other, gain=layout.at(gain)[other.texel])
    return _bytes(sheet)[layout.nearest]


@dataclass(frozen=True)
class _Layout:
    """The texels of a head's texture: `weights` (N, V) of the vertices at each covered one, and for every texel the
    covered one that is closest, `nearest` (size, size)."""

    weights: csr_array
    nearest: NDArray[np.int32]

    def at(self, values: NDArray[np.floating]) -> NDArray[np.float32]:
        """Values of the vertices (V, C) at the covered texels (N, C)."""
        return self.weights @ np.ascontiguousarray(values, np.float32)


@lru_cache(maxsize=2)
def _layout(head: StatisticalHead, size: int) -> _Layout:
    places = texels(head.corner_uv, size=size)
    vertices = head.triangles[places.triangle]
    starts = np.arange(0, 3 * len(vertices) + 1, 3, dtype=np.int32)
    parts = (np.ascontiguousarray(places.barycentric).ravel(), np.ascontiguousarray(vertices).ravel(), starts)
    weights = csr_array(parts, shape=(len(vertices), len(head.mean)))
    return _Layout(weights, places.nearest(size=size))


def _skin_at(
    image: NDArray[np.uint8],
    skin: NDArray[np.floating] | None,
    fitted: FittedHead,
    seen: NDArray[np.float64],
    head: StatisticalHead,
) -> SkinSeen | None:
    """What of the photograph is skin, by the colours that the middle of the face shows; None where it shows none."""
    xy = fitted.project(fitted.positions_in_view)
    cells = head_cells(image, skin=skin, xy=xy, px_per_metre=fitted.px_per_metre)
    if cells is None:
        return None
    masks = head.masks
    plain = (masks["face"] > 0.9) & (masks["eyes"] < 0.1) & (masks["lips"] < 0.1) & (masks["inside"] < 0.1)
    column, row = np.floor((xy - cells.corner) / cells.step).astype(int).T
    height, width = cells.skin.shape
    chosen = plain & (seen > 0.5) & (column >= 0) & (row >= 0) & (column < width) & (row < height)
    row, column = row[chosen], column[chosen]
    bare = cells.skin[row, column] > 0.9
    if not bare.any():
        return None
    model = skin_model(cells.image[row[bare], column[bare]])
    return skin_seen(cells, model=model, px_per_metre=fitted.px_per_metre)


def _field(
    skin_at: SkinSeen, xy: NDArray[np.float64], seen: NDArray[np.float64], head: StatisticalHead
) -> NDArray[np.float32]:
    """The smooth colour of the skin (V, 3) sRGB in [0, 1]."""
    cells = skin_at.cells(xy)
    known, sure = _remapped(skin_at.mean, cells), _remapped(skin_at.sure, cells)
    trust = sure * seen * (1 - head.masks["inside"]) * (1 - head.masks["lips"])
    return skin_field(known, trust=trust, far=skin_at.color, head=head)


def _tinted(
    field: NDArray[np.float32],
    head: StatisticalHead,
    scalp_color: NDArray[np.floating] | None,
    scalp_cover: NDArray[np.floating] | None,
) -> NDArray[np.float32]:
    """The smooth colour (V, 3) with the mouth's inside and the scalp in theirs."""
    tinted = _mixed(field, MOUTH_COLOR, head.masks["inside"] * (1 - head.masks["eyes"]))
    if scalp_color is None:
        return tinted
    amount = SCALP_TINT * head.masks["scalp"] if scalp_cover is None else ROOTS_TINT * np.asarray(scalp_cover)
    return _mixed(tinted, np.asarray(scalp_color, np.float32), amount.astype(np.float32))


def _mixed(field: NDArray[np.float32], color: NDArray[np.float32], amount: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.asarray(field + amount[:, None] * (color - field), np.float32)


@dataclass(frozen=True)
class _Photographed:
    """What the photograph shows at M `texel` (M,): `color` (M, 3) sRGB in [0, 1] and its `weight` (M,) in [0, 1]."""

    texel: NDArray[np.int64]
    color: NDArray[np.float32]
    weight: NDArray[np.float32]

    def weights(self, count: int) -> NDArray[np.float32]:
        """The weight of all `count` texels."""
        out = np.zeros(count, np.float32)
        out[self.texel] = self.weight
        return out


def _photographed(
    image: NDArray[np.uint8], skin_at: SkinSeen, place: NDArray[np.float32], *, before: _Photographed | None = None
) -> _Photographed:
    """What the photograph shows at the `place` of the texels (N, 4): x, y px, how well the camera sees them, and how
    far every colour counts there. It adds nothing where `before` shows enough."""
    height, width = image.shape[:2]
    x, y, seen, any_color = place.T
    inside = (x >= 0.5) & (y >= 0.5) & (x <= width - 0.5) & (y <= height - 0.5)
    worth = seen if before is None else seen * (before.weights(len(seen)) < ENOUGH)
    texel = np.flatnonzero((worth > 0) & inside)
    xy = place[texel, :2]
    bare, likely = _remapped(np.dstack([skin_at.bare, skin_at.likely]), skin_at.cells(xy)).T
    weight = seen[texel] * bare * np.maximum(any_color[texel], likely)
    if before is not None:
        weight *= np.clip(1 - before.weights(len(seen))[texel] / np.float32(ENOUGH), 0, 1)
    color = np.asarray(_remapped(image, xy - np.float32(0.5)) / np.float32(255), np.float32)
    return _Photographed(texel, color, weight)


def _paint(sheet: NDArray[np.float32], own: _Photographed, other: _Photographed, *, gain: NDArray[np.float32]) -> None:
    """Lays the photograph and its mirror image, brightened by `gain` (M, 3), over the `sheet` (N, 3) in place."""
    amount = own.weights(len(sheet)) + other.weights(len(sheet))
    scale = np.minimum(amount, 1) / np.maximum(amount, 1e-6)
    sheet *= (1 - np.minimum(amount, 1))[:, None]
    sheet[own.texel] += own.color * (own.weight * scale[own.texel])[:, None]
    sheet[other.texel] += other.color * gain * (other.weight * scale[other.texel])[:, None]


def _bytes(color: NDArray[np.float32]) -> NDArray[np.uint8]:
    return np.clip(color * np.float32(255) + np.float32(0.5), 0, 255).astype(np.uint8)


def _remapped(image: NDArray, xy: NDArray[np.floating]) -> NDArray:
    """`image` at columns and rows (N, 2), bilinear; in strips, since OpenCV's remap takes at most 32,767 rows."""
    side = int(np.ceil(np.sqrt(len(xy))))
    padded = np.zeros((2, side * side), np.float32)
    padded[:, : len(xy)] = xy.T
    x, y = padded.reshape(2, side, side)
    out = cv2.remap(image, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(out).reshape(side * side, *image.shape[2:])[: len(xy)]
