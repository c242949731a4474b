"""Colour and opacity of every vertex: from the photograph where it is seen, from hair near by where it is hidden."""

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import cv2
import numpy as np
from scipy.ndimage import binary_erosion, gaussian_filter1d

from tress.image.complete import complete
from tress.methods.portrait.clean_color import clean_color
from tress.methods.portrait.rim_tint import with_rim_tint
from tress.methods.portrait.volume import HairVolume

Array = np.ndarray[Any, Any]

ON_SHEET = 0.004
"""Metres behind the visible surface within which a visible strand shows the photograph's colour."""
SOLID_ALPHA = 0.9
"""Pixels with less hair lend no colour to hidden strands."""
GRAIN = 0.3
"""Share of what changes along a hidden strand, other than by the height, that is kept."""
LEVEL_BLUR = 0.03
"""Metres over which the mean colour of the heights is smooth."""
STRANDS_AT_ONCE = 4000
"""Strands that one thread colours at a time."""
LIKE_NEAR = 0.02
"""Metres behind the visible surface over which hidden hair takes after the hair before it."""
OWN_SHARE = 0.4
"""How much a hidden strand differs from the mean of its height."""
WIDTHS = 64
"""Places across the hair from which hidden strands draw their colour."""
COMPLETED_PX = 192
"""Longer side of the picture in which hidden hair is completed."""
COMPLETED_BLUR_PX = 2.0
"""Blur of that picture, since the completed hair stands for many strands behind each other."""
HEIGHT_GUIDE = 1.0
"""How strongly the completion keeps to the height, in units of colour over the whole height."""


def strand_colors(
    points: Array,
    offsets: Array,
    visible: Array,
    hair: HairVolume,
    foreground: Array,
    alpha: Array,
    before: Array,
    xy_from_view: Array,
    random: np.random.Generator,
) -> tuple[Array, Array, Array]:
    """(N, 3) float32 linear, (N,) float32, and whether the photograph shows the vertex (N,) bool: it then takes its own
    pixel of the matte.

    A hidden one takes the colour to which the hair is completed at its place (PatchMatch, guided by the height), and a
    part of what lies at a place across the hair drawn for its strand, so that roots, tips and locks differ as in the
    photograph; close behind visible hair, that hair. The rim beside pixels `before` (H, W), where background shines
    through, has the colour of the hair near it.
    """
    shape = alpha.shape
    scale = np.array([xy_from_view[0, 0], xy_from_view[1, 1]], np.float32)
    pixel = points[:, :2] * scale + xy_from_view[:2, 3].astype(np.float32)
    count = np.diff(offsets)
    solid = _solid(alpha, hair)
    clean = clean_color(foreground, solid, px_per_metre=xy_from_view[0, 0])
    across = _across(clean, solid)
    tinted = with_rim_tint(foreground, foreground=foreground, alpha=alpha, outer=~before, amount=1.0)
    drawn = random.integers(0, WIDTHS, len(count))
    completed = _completed(clean, solid, pixel, seed=int(random.integers(2**31)))
    near_by = cv2.GaussianBlur(clean, (0, 0), 2.0)
    level = _level(across, LEVEL_BLUR * xy_from_view[0, 0])
    color, opacity = np.empty((len(points), 3), np.float32), np.ones(len(points), np.float32)
    on_photo = np.zeros(len(points), np.bool_)

    def fill(first: int, end: int) -> None:
        """Colours of the strands from `first` on, before `end`."""
        part = slice(offsets[first], offsets[end])
        place, strands = pixel[part], count[first:end]
        index = _index(place, shape)
        behind = hair.sheet[index] - points[part, 2]
        own = across[index[0], np.repeat(drawn[first:end], strands)]
        found = (1 - OWN_SHARE) * _bilinear(completed, place) + OWN_SHARE * own
        near = np.nan_to_num(np.exp(-np.maximum(behind, 0) / LIKE_NEAR), nan=0.0).astype(np.float32)[:, None]
        found += near * (near_by[index] - found)
        found = _along_strands(found, level[index[0]], strands)
        shown = np.repeat(visible[first:end], strands) & (np.abs(behind) < ON_SHEET)
        found[shown] = _bilinear(tinted, place[shown])
        color[part] = found
        on_photo[part] = shown
        opacity[part][shown] = np.clip(_bilinear(alpha, place[shown]), 0, 1)

    with ThreadPoolExecutor() as pool:
        bounds = [*range(0, len(count), STRANDS_AT_ONCE), len(count)]
        list(pool.map(fill, bounds[:-1], bounds[1:]))
    return color, opacity, on_photo


def _along_strands(color: Array, level: Array, count: Array) -> Array:
    """(N, 3): a strand of `count` (S,) vertices differs from the `level` (N, 3) of its heights mostly by one colour.

    What lies at one height of the picture is a highlight as often as a lock; carried to the hidden side pixel by pixel
    it would run around the head as a band.
    """
    differs = color - level
    starts = np.concatenate([[0], np.cumsum(count)[:-1]])
    mean = np.add.reduceat(differs, starts, axis=0) / count[:, None].astype(np.float32)
    own = np.repeat(mean, count, axis=0)
    return np.maximum(level + own + GRAIN * (differs - own), 0)


def _level(across: Array, blur_px: float) -> Array:
    """(H, 3) float32: the mean colour of the hair at every height, smooth."""
    return gaussian_filter1d(across.mean(axis=1), max(blur_px, 0.5), axis=0, mode="nearest")


def _solid(alpha: Array, hair: HairVolume) -> Array:
    """(H, W) bool: pixels that are all hair, or those that have hair if there is none."""
    hairy = np.isfinite(hair.sheet)
    solid = hairy & (alpha > SOLID_ALPHA)
    return solid if solid.any() else hairy


def _completed(foreground: Array, solid: Array, pixel: Array, *, seed: int) -> Array:
    """(H, W, 3) float32: the picture of the hair, completed behind all that hides it where strands (N, 2) px run.

    Done at `COMPLETED_PX` pixels a side, since hidden hair is seen through nothing finer; smooth beyond its locks.
    """
    low, high = np.floor(pixel.min(axis=0)).astype(int), np.ceil(pixel.max(axis=0)).astype(int)
    top, left = (int(np.clip(low[k], 0, solid.shape[1 - k] - 1)) for k in (1, 0))
    box = slice(top, max(top + 1, high[1])), slice(left, max(left + 1, high[0]))
    height, width = solid[box].shape
    size = tuple(max(8, round(side * min(1.0, COMPLETED_PX / max(height, width)))) for side in (width, height))
    known = cv2.resize(solid[box].astype(np.float32), size, interpolation=cv2.INTER_AREA) > 0.99
    result = np.array(foreground, np.float32)
    if not binary_erosion(known, np.ones((3, 3))).any():
        result[:] = foreground[solid].mean(axis=0) if solid.any() else 0
        return result
    small = np.asarray(
        cv2.resize(np.asarray(foreground[box], np.float32), size, interpolation=cv2.INTER_AREA), np.float32
    )
    rows = np.linspace(0, HEIGHT_GUIDE, size[1]).astype(np.float32)
    level = np.repeat(rows[:, None, None], size[0], axis=1)
    filled = complete(small, hole=~known, source=known, guide=level, seed=seed)
    filled = cv2.GaussianBlur(filled, (0, 0), COMPLETED_BLUR_PX)
    result[box] = cv2.resize(filled, (width, height), interpolation=cv2.INTER_LINEAR)
    return result


def _across(foreground: Array, solid: Array) -> Array:
    """For every row of the photo (H, WIDTHS, 3) colours across its hair. Rows without hair take the nearest row's."""
    height = len(solid)
    across = np.zeros((height, WIDTHS, 3), np.float32)
    rows = np.nonzero(solid.any(axis=1))[0]
    for row in rows:
        columns = np.nonzero(solid[row])[0]
        across[row] = foreground[row, columns[np.linspace(0, len(columns) - 1, WIDTHS).astype(np.int64)]]
    nearest = rows[np.abs(np.arange(height)[:, None] - rows[None]).argmin(axis=1)] if len(rows) else np.arange(height)
    return across[nearest]


def _index(pixel: Array, shape: tuple[int, ...]) -> tuple[Array, Array]:
    """Rows and columns of the pixels that hold the places (N, 2), those outside moved to the border."""
    column, row = (np.clip(pixel[:, k].astype(np.int64), 0, shape[1 - k] - 1) for k in (0, 1))
    return row, column


def _bilinear(picture: Array, pixel: Array) -> Array:
    """Values (N, …) of a picture between its pixels' centres."""
    place = np.asarray(pixel, np.float32) - np.float32(0.5)
    rows = max(1, -(-len(place) // 8192))
    padded = np.zeros((rows * 8192, 2), np.float32)
    padded[: len(place)] = place
    grid = padded.reshape(rows, 8192, 2)
    found = cv2.remap(
        np.asarray(picture, np.float32), grid[..., 0], grid[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    return found.reshape(rows * 8192, *np.shape(picture)[2:])[: len(place)]
