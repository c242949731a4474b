"""What a stage of a reconstruction is, and how a list of stages is run from any of them on."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from tress import __version__
from tress.base.errors import InputError
from tress.base.report import Report
from tress.head.assets import asset
from tress.io.fingerprint import fingerprint
from tress.io.stage_cache import StageCache
from tress.methods.portrait.corrections import Corrections
from tress.methods.portrait.params import PortraitParams


@dataclass(frozen=True)
class Work:
    """What a stage may read: the photo, the parameters, the user's corrections and the results of the earlier stages.

    `pixels` (H, W, 3) uint8 sRGB; `alpha` (H, W) uint8 of a cut-out, or None; `results` by name of stage.
    """

    pixels: np.ndarray
    alpha: np.ndarray | None
    params: PortraitParams
    corrections: Corrections
    results: Mapping[str, Any] = field(default_factory=dict)

    def __getitem__(self, stage: str) -> Any:
        """The result of an earlier stage."""
        return self.results[stage]

    def with_result(self, stage: str, result: Any) -> "Work":
        """The work with one more result."""
        return replace(self, results={**self.results, stage: result})


@dataclass(frozen=True)
class Stage:
    """One stage: `run(work, report)` gives its typed result, `picture(work)` shows it (H, W, 3) uint8 sRGB.

    `corrections` names the user's corrections that it takes.
    """

    name: str
    run: Callable[[Work, Report], Any]
    picture: Callable[[Work], np.ndarray]
    corrections: tuple[str, ...] = ()


def run_stages(
    stages: Sequence[Stage], work: Work, *, start_from: str | None, cache: StageCache | None, report: Report
) -> Work:
    """The work with the result of every stage; those before `start_from` are loaded from `cache`.

    Raises `InputError` for an unknown stage, or where the cache was made from something else.
    """
    first = _first(stages, start_from, cache)
    prints = fingerprints(stages, work)
    for number, stage in enumerate(stages, start=1):
        if number <= first and cache is not None:
            result = cache.load(number=number, name=stage.name, fingerprint=prints[stage.name])
        else:
            with report.stage(stage.name):
                result = stage.run(work, report)
        work = work.with_result(stage.name, result)
    return work


def fingerprints(stages: Sequence[Stage], work: Work) -> dict[str, str]:
    """For every stage, what stands for all it depends on: photo, parameters, corrections, version, head model."""
    sofar = fingerprint(__version__, asset("provenance.json").read_text(), work.pixels, work.alpha, work.params.seed)
    result: dict[str, str] = {}
    for stage in stages:
        corrections = [getattr(work.corrections, name) for name in stage.corrections]
        sofar = fingerprint(sofar, stage.name, getattr(work.params, stage.name, None), corrections)
        result[stage.name] = sofar
    return result


def _first(stages: Sequence[Stage], start_from: str | None, cache: StageCache | None) -> int:
    """How many stages are loaded and not run."""
    names = [stage.name for stage in stages]
    if start_from is None:
        return 0
    if start_from not in names:
        raise InputError(f"{start_from} is no stage; one of {', '.join(names)} was expected.")
    if cache is None:
        raise InputError(f"Starting from {start_from} needs the results of an earlier run; none were given.")
    return names.index(start_from)
