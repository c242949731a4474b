"""How large the texture of a level of detail has to be, and the level of a mip chain that is."""

import math
from collections.abc import Sequence

from tress.base.errors import InputError
from tress.model.atlas import Atlas
from tress.render.textures.mip_chain import MipLevel

_LEAST = 16


def level_resolution(resolution: int, *, size_on_screen: float) -> int:
    """The power of two nearest to `resolution` px times `size_on_screen`, but at least 16 and at most `resolution`.

    `size_on_screen` is how long the hair is on the screen where a level takes over, as a share of its length where the
    finest level is seen closest: the nearest distance over the level's, for a camera that only moves. So a texel of any
    level is as large on the screen as one of the finest, to within a factor of the square root of 2.
    Raises `InputError` for a resolution below 1 and a size that is not positive.

    >>> level_resolution(2048, size_on_screen=0.25)
    512
    """
    if resolution < 1 or not 0 < size_on_screen < math.inf:
        raise InputError(f"{resolution} px at {size_on_screen} of the size were given; positive numbers were expected.")
    wanted = round(math.log2(resolution * min(size_on_screen, 1)))
    return min(max(2**wanted if wanted > 0 else 1, _LEAST), resolution)


def resolutions_of_budgets(budgets: Sequence[int], *, resolution: int) -> tuple[int, ...]:
    """The resolution of every level of a chain of triangle `budgets`, the first the finest, which has `resolution` px.

    Triangles are meant to keep their size on the screen; so the hair's area there goes as the budget, its length as the
    square root. Raises `InputError` for budgets that are not positive.

    >>> resolutions_of_budgets([20000, 8000, 2000], resolution=2048)
    (2048, 1024, 512)
    """
    if not budgets or min(budgets) < 1:
        raise InputError(f"The budgets are {list(budgets)}; at least one triangle a level was expected.")
    return tuple(level_resolution(resolution, size_on_screen=math.sqrt(budget / budgets[0])) for budget in budgets)


def atlas_of_resolution(chain: Sequence[MipLevel], *, resolution: int) -> Atlas:
    """The smallest atlas of the `chain` that is at least `resolution` px wide; the finest where none is."""
    wide_enough = [level.atlas for level in chain if level.atlas.color.shape[1] >= resolution]
    return wide_enough[-1] if wide_enough else chain[0].atlas
