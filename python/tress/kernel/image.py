"""Hair in the image plane: oriented filters, seeds, traced curves, completion. All run on every core.

Images are (H, W) float32, row by row; points are (x, y) in pixels, the first pixel's centre at (0.5, 0.5), y down.
Every function raises `InputError` for wrong shapes, numbers that are not finite and settings that cannot work.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class GaborSizes:
    """Sizes of an even Gabor kernel in pixels: standard deviations across and along the strand, and wavelength."""

    sigma_u: float = 1.8
    sigma_v: float = 2.4
    wavelength: float = 4.0

    def scaled(self, factor: float) -> "GaborSizes":
        """All sizes times `factor`."""
        return GaborSizes(self.sigma_u * factor, self.sigma_v * factor, self.wavelength * factor)


@dataclass(frozen=True, eq=False)
class Curves:
    """Curves in the image: `points` (N, 2) float32 px; curve i is `points[offsets[i]:offsets[i + 1]]`.

    `occluded` (N,) bool: passes under another curve there. `confidence` (N,) float32, 0 where occluded.
    """

    points: Array
    offsets: Array
    occluded: Array
    confidence: Array


def gabor_responses(image: Array, *, sizes: GaborSizes = GaborSizes(), orientations: int = 32) -> Array:
    """(orientations, H, W) float32: response to each kernel of the bank; kernel k oscillates along k π / orientations.

    The border of the image is repeated. Source: Chai et al. 2012, eq. 2.
    """
    return _answer(_core.image_gabor_responses, _plane(image, "image"), _sizes(sizes), int(orientations))


def orient(
    image: Array,
    *,
    mask: Array,
    sizes: Sequence[GaborSizes] = (GaborSizes(),),
    orientations: int = 32,
    between_bins: bool = True,
    ridges_only: bool = False,
) -> tuple[Array, Array]:
    """Strand direction (H, W) float32 in [0, π), NaN outside `mask`, and its confidence before scaling, 0 outside.

    Bright ridges of `image` are found, only inside `mask` (H, W) bool. Of the banks with the given `sizes`, each pixel
    takes the one that answers most strongly. `between_bins` refines the best kernel's angle by a parabola.
    `ridges_only` takes negative responses for none, so that the valleys beside a strand get no confidence. Source: Chai
    et al. 2012, eq. 2 and 3.

    >>> stripes = np.tile(np.cos(np.arange(40) * np.pi / 2), (40, 1))
    >>> angle, _ = orient(stripes, mask=np.ones((40, 40), bool))
    >>> float(np.rad2deg(angle[20, 20]).round(3))
    90.0
    """
    values = _plane(image, "image")
    inside = _mask(mask, values)
    banks = [_sizes(one) for one in sizes]
    return _answer(_core.image_orient, values, inside, banks, int(orientations), bool(between_bins), bool(ridges_only))


def ridge_seeds(angle: Array, *, confidence: Array, high: float, epsilon: float, reach_px: float) -> Array:
    """(K, 2) int64 rows and columns where `confidence` has a ridge along `angle` (NaN: none), strongest first.

    Source: Chai et al. 2012, eq. 4.
    """
    weight = _plane(confidence, "confidence")
    found = _answer(_core.image_seeds, _angle(angle, weight), weight, float(high), float(epsilon), float(reach_px))
    return np.stack(np.divmod(found, weight.shape[1]), axis=1)


def trace(
    angle: Array,
    *,
    confidence: Array,
    mask: Array,
    high: float,
    low: float,
    epsilon: float,
    health: int,
    step_px: float,
    max_bend: float,
    reach_px: float,
    min_length_px: float,
    smoothing_px: float,
) -> Curves:
    """Curves along the ridges of `confidence` (H, W), in the directions `angle` (H, W), NaN where unknown.

    Curves end where they leave `mask` (H, W) bool. Source: Chai et al. 2012, section 3.2.2.
    """
    weight = _plane(confidence, "confidence")
    found = _answer(
        _core.image_trace,
        _angle(angle, weight),
        weight,
        _mask(mask, weight),
        high=float(high),
        low=float(low),
        epsilon=float(epsilon),
        health=int(health),
        step_px=float(step_px),
        max_bend=float(max_bend),
        reach_px=float(reach_px),
        min_length_px=float(min_length_px),
        smoothing_px=float(smoothing_px),
    )
    return Curves(*found)


def complete(
    picture: Array,
    *,
    hole: Array,
    source: Array,
    guide: Array | None = None,
    patch: int,
    levels: int,
    rounds: int,
    seed: int,
) -> Array:
    """`picture` (H, W, C) with the pixels of `hole` (H, W) bool copied, patch by patch, from where `source` holds.

    `guide` (H, W, G), known everywhere, takes part in the comparison of patches. What is in the hole does not matter
    and may be NaN. Raises `InputError` where no whole patch lies in the source. Source: Barnes et al. 2009, Wexler et
    al. 2007.
    """
    given = np.asarray(picture, np.float32)
    if given.ndim != 3 or given.shape[2] == 0:
        raise InputError(f"picture is {given.shape}; (H, W, C) was expected.")
    where = np.asarray(hole)
    inside, whole = _mask(where, given[..., 0]), np.where(where[..., None], 0, given) if where.ndim == 2 else given
    parts = [whole] if guide is None else [whole, np.asarray(guide, np.float32)]
    if guide is not None and (parts[1].ndim != 3 or parts[1].shape[:2] != where.shape):
        raise InputError(f"guide is {parts[1].shape}; ({where.shape[0]}, {where.shape[1]}, any) was expected.")
    stacked = checked(np.concatenate(parts, axis=2), name="picture", dtype=np.float32, shape=(None, None, None))
    filled = _answer(
        _core.image_complete,
        stacked,
        inside,
        _mask(source, given[..., 0]),
        guides=stacked.shape[2] - given.shape[2],
        patch=int(patch),
        levels=int(levels),
        rounds=int(rounds),
        seed=int(seed),
    )
    return filled[..., : given.shape[2]]


def _answer(function: Callable[..., Any], *arguments: Any, **settings: Any) -> Any:
    try:
        return function(*arguments, **settings)
    except (ValueError, OverflowError) as error:
        raise InputError(f"The picture cannot be used: {error}.") from error


def _plane(value: Array, name: str) -> Array:
    return checked(value, name=name, dtype=np.float32, shape=(None, None))


def _angle(value: Array, like: Array) -> Array:
    """Angles may be NaN, where they are unknown."""
    given = np.asarray(value, np.float32)
    checked(
        np.nan_to_num(given, nan=0.0, posinf=np.inf, neginf=np.inf), name="angle", dtype=np.float32, shape=like.shape
    )
    return np.ascontiguousarray(given)


def _mask(value: Array, like: Array) -> Array:
    given = np.asarray(value)
    if given.dtype != np.bool_ or given.shape != like.shape:
        raise InputError(f"mask is {given.dtype} {given.shape}; bool {like.shape} was expected.")
    return np.ascontiguousarray(given)


def _sizes(sizes: GaborSizes) -> tuple[float, float, float]:
    return (float(sizes.sigma_u), float(sizes.sigma_v), float(sizes.wavelength))
