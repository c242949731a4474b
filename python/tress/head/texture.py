"""The head's texture out of the photograph.

Every texel knows its place on the head. Where that place faces the camera, is not behind another part of the head and
shows skin, the photograph's colour is taken; where it does not, that of its mirror image on the other side of the
head, brought to the same brightness; and where neither is seen, colours spread in from around, towards the median of
the skin. The blends are weighted, so that no edge shows between the three. Limits: the photograph's light stays in the
texture; hair that the mask missed is painted on.
"""

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.head.fit import FittedHead
from tress.head.scalp import vertex_normals
from tress.head.statistical import StatisticalHead, load_statistical_head
from tress.head.texels import Texels, texels
from tress.kernel.geom import rays_blocked

FACING = (0.25, 0.6)
"""Cosine between normal and camera at which the photograph begins to count, and counts fully."""
ENOUGH = 0.6
"""Weight of the photograph from which the mirror image adds nothing."""
SPREAD = 0.02
"""Weight of the skin's median against what spreads in from around."""
MOUTH_COLOR = np.array([0.25, 0.10, 0.10])
"""sRGB of the mouth's inside."""
LIFT_M = 5e-4


def head_texture(
    image: NDArray[np.uint8],
    *,
    fitted: FittedHead,
    skin: NDArray[np.floating] | None = None,
    scalp_color: NDArray[np.floating] | None = None,
    size: int = 1024,
    head: StatisticalHead | None = None,
) -> NDArray[np.uint8]:
    """The texture (size, size, 3) uint8 sRGB for `fitted.corner_uv`, row 0 on top (v up), from `image` (H, W, 3) uint8
    sRGB.

    `skin` (H, W) in [0, 1] says where the photograph shows bare skin, so that no hair is painted on the head; without
    it all of the head but scalp and neck counts. `scalp_color` (3,) sRGB in [0, 1] tints the scalp, as hair roots do.
    About 0.6 s.
    """
    head = head or load_statistical_head()
    places = _texels(head, size)
    weight_at = _pockets_like_rims(_facing(fitted), head)
    if skin is None:
        weight_at = weight_at * (1 - head.masks["scalp"]) * (1 - head.masks["neck"])
    own, own_weight = _photographed(image, skin, fitted, weight_at, places, None)
    other, other_weight = _photographed(image, skin, fitted, weight_at, places, head.mirror)
    other = np.clip(other * _gain(own, own_weight, other, other_weight), 0, 1)
    other_weight = other_weight * np.clip(1 - own_weight / ENOUGH, 0, 1)
    total = own_weight + other_weight
    color = (own * own_weight[:, None] + other * other_weight[:, None]) / np.maximum(total, 1e-6)[:, None]
    skin_color = _skin_color(own, own_weight * _at(head.masks["face"], head, places))
    sheet, known = np.zeros((size, size, 3), np.float32), np.zeros((size, size), np.float32)
    sheet[places.row, places.column], known[places.row, places.column] = color, total
    sheet = _spread(sheet, known, skin_color)
    mouth = _at(head.masks["inside"] * (1 - head.masks["eyes"]), head, places)
    _tint(sheet, places, mouth * np.clip(1 - 2 * own_weight, 0, 1), MOUTH_COLOR)
    if scalp_color is not None:
        _tint(sheet, places, _at(head.masks["scalp"], head, places), np.asarray(scalp_color))
    return np.clip(np.rint(sheet * 255), 0, 255).astype(np.uint8)


@lru_cache(maxsize=2)
def _texels_of(uv: bytes, size: int) -> Texels:
    return texels(np.frombuffer(uv, np.float32).reshape(-1, 3, 2), size=size)


def _texels(head: StatisticalHead, size: int) -> Texels:
    return _texels_of(np.ascontiguousarray(head.corner_uv, np.float32).tobytes(), size)


def _facing(fitted: FittedHead) -> NDArray[np.float64]:
    """How well the camera sees each vertex (V,), in [0, 1]."""
    positions = fitted.positions_in_view
    normals = vertex_normals(positions, triangles=fitted.triangles)
    toward = np.broadcast_to([0.0, 0.0, 1.0], positions.shape)
    origins = positions + LIFT_M * (normals + toward)
    hidden = rays_blocked(positions, triangles=fitted.triangles, origins=origins, directions=toward)
    t = np.clip((normals[:, 2] - FACING[0]) / (FACING[1] - FACING[0]), 0, 1)
    return t * t * (3 - 2 * t) * ~np.asarray(hidden, bool)


def _pockets_like_rims(weight_at: NDArray[np.float64], head: StatisticalHead) -> NDArray[np.float64]:
    """Mouth bag, eye sockets and eyeballs count as their lips and lids do on that side, on the whole: so teeth and eyes
    are painted where they show, and what is hidden now looks like its surroundings when the head turns."""
    masks, side = head.masks, head.mean[:, 0] > 0
    skin = np.arange(len(side)) < head.skin_count
    pockets = (masks["inside"] > 0.5) | ~skin
    weight = weight_at.copy()
    for name, filled in (("eyes", pockets & (masks["eyes"] > 0.5)), ("lips", pockets & (masks["eyes"] <= 0.5))):
        rim = (masks[name] > 0.5) & ~pockets
        for half in (side, ~side):
            weight[filled & half] = weight_at[rim & half].mean()
    return weight


def _photographed(
    image: NDArray[np.uint8],
    skin: NDArray[np.floating] | None,
    fitted: FittedHead,
    weight_at: NDArray[np.float64],
    places: Texels,
    mirror: NDArray[np.int32] | None,
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Colour (N, 3) in [0, 1] of the photograph at the texels (or at their mirror images) and its weight (N,)."""
    vertices = fitted.triangles[places.triangle]
    if mirror is not None:
        vertices = mirror[vertices]
    xy = np.einsum("nk,nkd->nd", places.barycentric, fitted.project(fitted.positions_in_view)[vertices])
    weight = np.einsum("nk,nk->n", places.barycentric, weight_at[vertices])
    x, y = (xy.T.reshape(2, -1, 1) - 0.5).astype(np.float32)
    color = (_remapped(image, x, y) / np.float32(255)).astype(np.float32)
    inside = (x[:, 0] >= 0) & (y[:, 0] >= 0) & (x[:, 0] <= image.shape[1] - 1) & (y[:, 0] <= image.shape[0] - 1)
    weight = weight * inside
    if skin is not None:
        weight = weight * _remapped(np.asarray(skin, np.float32), x, y) ** 2
    return color, np.asarray(weight, np.float32)


def _remapped(image: NDArray, x: NDArray[np.float32], y: NDArray[np.float32]) -> NDArray:
    """`image` at N points, bilinear; in strips, since OpenCV's remap takes at most 32,767 rows."""
    side = int(np.ceil(np.sqrt(len(x))))
    pad = side * side - len(x)
    xs, ys = (np.pad(part[:, 0], (0, pad)).reshape(side, side) for part in (x, y))
    out = cv2.remap(image, xs, ys, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(out).reshape(side * side, *image.shape[2:])[: len(x)]


def _gain(
    own: NDArray[np.float32],
    own_weight: NDArray[np.float32],
    other: NDArray[np.float32],
    other_weight: NDArray[np.float32],
) -> NDArray[np.float32]:
    """What the mirror image is multiplied by (3,) to be as bright as the photograph where both are seen half-way."""
    both = own_weight * other_weight * np.clip(1 - own_weight, 0.02, 1)
    if both.sum() <= 0:
        return np.ones(3, np.float32)
    return np.clip(_sum(both, own) / np.maximum(_sum(both, other), 1e-6), 0.5, 2.0).astype(np.float32)


def _sum(weight: NDArray[np.float32], color: NDArray[np.float32]) -> NDArray[np.float64]:
    return np.einsum("n,nc->c", weight.astype(np.float64), color.astype(np.float64))


def _skin_color(color: NDArray[np.float32], weight: NDArray[np.float32]) -> NDArray[np.float32]:
    seen = weight > 0.5
    if not seen.any():
        return np.array([0.72, 0.55, 0.47], np.float32)
    return np.median(color[seen], axis=0).astype(np.float32)


def _at(values: NDArray[np.floating], head: StatisticalHead, places: Texels) -> NDArray[np.float32]:
    """A mask of the vertices at the texels (N,)."""
    return np.einsum("nk,nk->n", places.barycentric, values[head.triangles[places.triangle]]).astype(np.float32)


def _tint(sheet: NDArray[np.float32], places: Texels, amount: NDArray[np.float32], color: NDArray[np.floating]) -> None:
    here = sheet[places.row, places.column]
    sheet[places.row, places.column] = here + amount[:, None] * (color.astype(np.float32) - here)


def _spread(
    sheet: NDArray[np.float32], known: NDArray[np.float32], far_color: NDArray[np.float32]
) -> NDArray[np.float32]:
    """Fills what is not `known` by push and pull through a pyramid: ever coarser averages of what is, then back up."""
    premultiplied = np.dstack([sheet * known[..., None], known])
    levels = [premultiplied]
    while min(levels[-1].shape[:2]) > 2:
        half = (max(1, levels[-1].shape[1] // 2), max(1, levels[-1].shape[0] // 2))
        levels.append(np.asarray(cv2.resize(levels[-1], half, interpolation=cv2.INTER_AREA), np.float32))
    filled = np.broadcast_to(far_color, (*levels[-1].shape[:2], 3)).astype(np.float32)
    for level in reversed(levels):
        size = (level.shape[1], level.shape[0])
        filled = np.asarray(cv2.resize(filled, size, interpolation=cv2.INTER_LINEAR), np.float32)
        filled = filled.reshape(*size[::-1], 3)
        filled += SPREAD * (far_color - filled)
        average = level[..., :3] / np.maximum(level[..., 3:], 1e-6)
        filled += np.clip(1.5 * level[..., 3:], 0, 1) * (average - filled)
    return filled
