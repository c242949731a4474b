"""The order of the stages: photograph in, reconstruction out."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tress.base.report import Report
from tress.io.stage_cache import StageCache
from tress.methods.portrait import steps
from tress.methods.portrait.corrections import Corrections
from tress.methods.portrait.document import portrait_document
from tress.methods.portrait.params import PortraitParams
from tress.methods.portrait.stage import Stage, Work, fingerprints, run_stages
from tress.model.document import Document

STAGES: Final[tuple[Stage, ...]] = (
    Stage("head", steps.run_head, steps.show_head, corrections=("face", "landmarks")),
    Stage("layers", steps.run_layers, steps.show_layers, corrections=("strokes",)),
    Stage("matte", steps.run_matte, steps.show_matte),
    Stage("orientation", steps.run_orientation, steps.show_orientation),
    Stage("trace", steps.run_trace, steps.show_trace),
    Stage("depth", steps.run_depth, steps.show_depth, corrections=("depth_strokes",)),
    Stage("volume", steps.run_volume, steps.show_volume),
    Stage("strands", steps.run_strands, steps.show_strands),
    Stage("color", steps.run_color, steps.show_color),
)
"""Every stage in order; a new one is its file, its step and a line here."""


@dataclass(frozen=True)
class Reconstruction:
    """The finished `work` with the result of every stage, its `document`, and their fingerprints."""

    work: Work
    document: Document
    fingerprints: dict[str, str]


def reconstruct(
    pixels: NDArray[np.uint8],
    *,
    alpha: NDArray[np.uint8] | None = None,
    params: PortraitParams | None = None,
    corrections: Corrections | None = None,
    start_from: str | None = None,
    cache: StageCache | None = None,
    report: Report | None = None,
) -> Reconstruction:
    """Hair from one portrait photograph `pixels` (H, W, 3) uint8 sRGB, upright.

    `alpha` (H, W) uint8 says where the person is, if the photo is a cut-out. With `start_from`, the results of the
    stages before it come from `cache`. Raises `NoFaceError`, `NoHairError`, and `InputError` where cache and inputs do
    not fit together.
    """
    report = report or Report()
    work = Work(pixels, alpha, params or PortraitParams(), corrections or Corrections())
    done = run_stages(STAGES, work, start_from=start_from, cache=cache, report=report)
    with report.stage("document"):
        document = portrait_document(done)
    return Reconstruction(done, document, fingerprints(STAGES, work))
