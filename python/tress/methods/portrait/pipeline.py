"""The order of the stages: photograph in, reconstruction out."""

from typing import Final

import numpy as np

from tress.base.report import Report
from tress.io.stage_cache import StageCache
from tress.methods.portrait.corrections import Corrections
from tress.methods.portrait.params import PortraitParams
from tress.methods.portrait.stage import Stage, Work, run_stages

STAGES: Final[tuple[Stage, ...]] = ()
"""Every stage in order; a new one is its file and a line here."""


def reconstruct(
    pixels: np.ndarray,
    *,
    alpha: np.ndarray | None = None,
    params: PortraitParams | None = None,
    corrections: Corrections | None = None,
    start_from: str | None = None,
    cache: StageCache | None = None,
    report: Report | None = None,
) -> Work:
    """Hair from one portrait photograph `pixels` (H, W, 3) uint8 sRGB, upright.

    `alpha` (H, W) uint8 says where the person is, if the photo is a cut-out. With `start_from`, the results of the
    stages before it come from `cache`.
    """
    work = Work(pixels, alpha, params or PortraitParams(), corrections or Corrections())
    return run_stages(STAGES, work, start_from=start_from, cache=cache, report=report or Report())
