"""Holes in pictures, filled with patches from elsewhere: hair hidden by other hair, a background behind a person."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.errors import InputError
from tress.base.params import Params, param
from tress.kernel import image as kernel


@dataclass(frozen=True)
class CompleteParams(Params):
    """Settings of `complete`."""

    patch: int = param(7, low=3, high=21, unit="px", doc="Side of the patches; an odd number.")
    levels: int = param(6, low=1, high=12, doc="Most levels of the pyramid, each half the size of the one before.")
    rounds: int = param(2, low=1, high=20, doc="Rounds of search and vote on the finest level.")


def complete(
    picture: NDArray[np.floating],
    *,
    hole: NDArray[np.bool_],
    source: NDArray[np.bool_] | None = None,
    guide: NDArray[np.floating] | None = None,
    seed: int = 0,
    params: CompleteParams = CompleteParams(),
) -> NDArray[np.float32]:
    """`picture` (H, W, C) or (H, W), float32, with the pixels of `hole` (H, W) bool filled; the others keep their bits.

    Patches are copied from where `source` (H, W) bool holds, the hole excluded; by default from everywhere. `guide`
    (H, W, G), known everywhere and in the units of the picture, steers which: hair of the same direction, say. Same
    seed, same bits. Where patches of the wanted size do not fit into the source, smaller ones are tried. Costs about
    0.2 s for a hole of 200 x 200 px. Raises `InputError` where shapes do not fit, where a known number is not finite,
    and where the source holds no patch of 3 x 3 px.

    >>> stripes = np.tile(np.arange(60) % 4 < 2, (60, 1)).astype(np.float32)
    >>> hole = np.zeros((60, 60), bool)
    >>> hole[24:36, 24:36] = True
    >>> float(np.abs(complete(stripes, hole=hole) - stripes).mean()) < 0.01
    True
    """
    if (
        picture.ndim not in (2, 3)
        or hole.shape != picture.shape[:2]
        or (source is not None and source.shape != hole.shape)
    ):
        raise InputError(
            f"picture {picture.shape} and hole {hole.shape} do not fit; (H, W, C) and (H, W) were expected."
        )
    flat = picture[..., None] if picture.ndim == 2 else picture
    offered = np.ones_like(hole) if source is None else source
    sizes = [size for size in (params.patch, 7, 5) if size <= params.patch and _fits(offered & ~hole, size)]
    filled = kernel.complete(
        flat,
        hole=hole,
        source=offered,
        guide=guide,
        patch=sizes[0] if sizes else 3,
        levels=params.levels,
        rounds=params.rounds,
        seed=seed,
    )
    return filled[..., 0] if picture.ndim == 2 else filled


def _fits(source: NDArray[np.bool_], size: int) -> bool:
    """Whether some window of `size` x `size` px lies wholly in the source."""
    if min(source.shape) < size:
        return False
    counts = np.pad(source.astype(np.int64).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    inside = counts[size:, size:] - counts[:-size, size:] - counts[size:, :-size] + counts[:-size, :-size]
    return bool((inside == size * size).any())
