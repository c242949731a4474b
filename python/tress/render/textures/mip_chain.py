"""Mip chains whose alpha test passes the same share of every card on every level.

Averaging draws alpha to its mean: a strand half a texel wide has alpha 0.5 at most, and a test at 0.5 drops it, so that
hair thins out with distance. On every level the alpha of each card is scaled by the factor that restores the coverage
of the finest level (Castaño, *Computing Alpha Mipmaps*, 2010). Factors are found card by card, since sparse cards need
larger ones. Colours and other maps are averaged with the unscaled alpha as weight, directions are made unit again, and
what lies under zero alpha is continued from the strands of the same card.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.kernel.alpha_coverage import alpha_coverage, alpha_scale
from tress.model.atlas import Atlas
from tress.render.textures.dilate import dilated
from tress.render.textures.encode import share_bytes, shares
from tress.render.textures.map_codec import COLOR, STRAND_ID, codec_of

Array = np.ndarray[Any, Any]

_COLOR = "color"
_LEAST_TEXELS = 4
"""A card of fewer texels across shows no strands, and its coverage moves in steps of many hundredths."""


@dataclass(frozen=True, eq=False)
class MipLevel:
    """One level, each half the size of the last; per region the factor on alpha and the share that passes the test.

    `scale` (R,) float64; `coverage` (R,) float64 of the cell's area, measured on the bytes.
    """

    atlas: Atlas
    scale: Array
    coverage: Array


@dataclass(frozen=True, eq=False)
class _Cell:
    """A card with its border on one level: alpha (H, W), other maps premultiplied by it, and ids (H, W)."""

    alpha: Array
    premultiplied: Mapping[str, Array]
    ids: Array | None

    def halved(self) -> "_Cell":
        return _Cell(
            _quartered(self.alpha),
            {name: _quartered(values) for name, values in self.premultiplied.items()},
            None if self.ids is None else _of_heaviest(self.ids, self.alpha),
        )


def mip_chain(atlas: Atlas, *, padding: int, threshold: float) -> tuple[MipLevel, ...]:
    """The atlas and its smaller levels, down to the last on which cards are 4 texels wide and cannot bleed into others.

    `padding` is the empty border around every region in pixels of the atlas; it decides how many levels there are:
    cells must begin and end between texels, and the border must keep half a texel. Maps must be uint8.
    Raises `InputError` where regions and padding are no whole pixels inside the picture, or overlap.
    """
    boxes = _cell_boxes(atlas, padding)
    cells = [_cell(atlas, box) for box in boxes]
    wanted = [alpha_coverage(cell.alpha, threshold=threshold) for cell in cells]
    levels = [MipLevel(atlas, np.ones(len(boxes)), np.array(wanted))]
    for level in range(1, clear_levels(atlas, padding=padding)):
        cells = [cell.halved() for cell in cells]
        levels.append(_level(atlas, boxes // 2**level, cells, wanted, threshold, level))
    return tuple(levels)


def clear_levels(atlas: Atlas, *, padding: int) -> int:
    """How many levels, the first included, keep cards apart and 4 texels wide; refuses what `mip_chain` does."""
    boxes, level = _cell_boxes(atlas, padding), 0
    narrowest = (boxes[:, 2:] - boxes[:, :2]).min() - 2 * padding
    while padding >= 2**level and narrowest >= _LEAST_TEXELS * 2 ** (level + 1) and _halves(atlas, boxes, level + 1):
        level += 1
    return level + 1


def _halves(atlas: Atlas, boxes: Array, level: int) -> bool:
    """Whether picture and cells still begin and end between the texels of a level."""
    return not (np.array([*atlas.color.shape[:2], *boxes.ravel()]) % 2**level).any()


def _cell_boxes(atlas: Atlas, padding: int) -> Array:
    """(R, 4) int64: first row, first column, end row, end column of every region with its border."""
    height, width = atlas.color.shape[:2]
    u_low, v_low, u_high, v_high = atlas.regions.astype(np.float64).T
    exact = np.stack([(1 - v_high) * height, u_low * width, (1 - v_low) * height, u_high * width], axis=1)
    boxes = np.rint(exact).astype(np.int64)
    if np.abs(exact - boxes).max() > 1e-2:
        raise InputError("Regions of the atlas begin or end within pixels; whole pixels were expected.")
    boxes += np.array([-padding, -padding, padding, padding])
    if (boxes < 0).any() or (boxes[:, 2:] > [height, width]).any():
        raise InputError(f"Regions of the atlas have less than {padding} px of border; lower the padding.")
    used = np.zeros((height, width), np.uint8)
    for top, left, bottom, right in boxes:
        used[top:bottom, left:right] += 1
        if used[top:bottom, left:right].max() > 1:
            raise InputError(f"Regions of the atlas are less than {2 * padding} px apart; lower the padding.")
    return boxes


def _cell(atlas: Atlas, box: Array) -> _Cell:
    rgba = _cut(atlas.color, box)
    alpha = shares(rgba[..., 3])
    values = {_COLOR: COLOR.decode(rgba[..., :3])}
    for name, pixels in atlas.maps.items():
        if pixels.dtype != np.uint8:
            raise InputError(f"Atlas.maps[{name!r}] has dtype {pixels.dtype}; uint8 was expected.")
        if name != STRAND_ID:
            values[name] = codec_of(name).decode(_cut(pixels, box))
    ids = _cut(atlas.maps[STRAND_ID], box) if STRAND_ID in atlas.maps else None
    return _Cell(alpha, {name: _weighted(field, alpha) for name, field in values.items()}, ids)


def _level(
    atlas: Atlas, boxes: Array, cells: list[_Cell], wanted: list[float], threshold: float, level: int
) -> MipLevel:
    height, width = (side >> level for side in atlas.color.shape[:2])
    pictures = {_COLOR: atlas.color, **atlas.maps}
    maps = {name: np.zeros((height, width, *pixels.shape[2:]), np.uint8) for name, pixels in pictures.items()}
    scale, coverage = np.ones(len(cells)), np.zeros(len(cells))
    for index, (cell, box) in enumerate(zip(cells, boxes, strict=True)):
        scale[index] = alpha_scale(cell.alpha, threshold=threshold, coverage=wanted[index])
        alpha = share_bytes(cell.alpha * scale[index])
        coverage[index] = alpha_coverage(shares(alpha), threshold=threshold)
        for name, values in _cell_bytes(cell, alpha).items():
            _cut(maps[name], box)[:] = values
    color = maps.pop(_COLOR)
    return MipLevel(Atlas(color=color, regions=atlas.regions, maps=maps), scale, coverage)


def _cell_bytes(cell: _Cell, alpha: Array) -> dict[str, Array]:
    """Bytes of every map of a cell with the scaled `alpha`, continued under zero alpha."""
    straight = {name: _straight(values, cell.alpha) for name, values in cell.premultiplied.items()}
    pixels = {name: codec_of(name).encode(values) for name, values in straight.items() if name != _COLOR}
    pixels[_COLOR] = COLOR.encode(straight[_COLOR])
    if cell.ids is not None:
        pixels[STRAND_ID] = cell.ids
    pixels = dilated(pixels, alpha=alpha)
    pixels[_COLOR] = np.concatenate([pixels[_COLOR], alpha[..., None]], axis=-1)
    return pixels


def _cut(pixels: Array, box: Array) -> Array:
    top, left, bottom, right = box
    return pixels[top:bottom, left:right]


def _weighted(values: Array, alpha: Array) -> Array:
    return values * (alpha if values.ndim == alpha.ndim else alpha[..., None])


def _straight(values: Array, alpha: Array) -> Array:
    weight = alpha if values.ndim == alpha.ndim else alpha[..., None]
    return np.divide(values, weight, out=np.zeros_like(values), where=weight > 0)


def _quarters(values: Array) -> list[Array]:
    return [values[row::2, column::2] for row in (0, 1) for column in (0, 1)]


def _quartered(values: Array) -> Array:
    """Means of 2 x 2 texels."""
    a, b, c, d = _quarters(values)
    return (a + b + c + d) * np.float32(0.25)


def _of_heaviest(ids: Array, alpha: Array) -> Array:
    """Of 2 x 2 texels the id of the one with the largest alpha, the first of equals."""
    heaviest = np.argmax(np.stack(_quarters(alpha)), axis=0)
    return np.take_along_axis(np.stack(_quarters(ids)), heaviest[None], axis=0)[0]
