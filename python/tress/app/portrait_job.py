"""One photograph to one folder: the job that the command runs, and that a batch can run many of."""

from dataclasses import dataclass, replace
from pathlib import Path

from tress.app.settings import with_settings
from tress.base.report import Report
from tress.io.photo import Photo, read_photo
from tress.io.stage_cache import StageCache
from tress.methods.portrait.corrections import Corrections
from tress.methods.portrait.params import PortraitParams
from tress.methods.portrait.pipeline import reconstruct

STAGES_FOLDER = "stages"


@dataclass(frozen=True)
class Delivery:
    """What was written: a folder and the files in it, relative to it."""

    folder: Path
    files: tuple[Path, ...]


@dataclass(frozen=True)
class PortraitOptions:
    """What the user asked for; the fields are those of `tress portrait --help`."""

    photo: Path
    folder: Path
    seed: int = 0
    strands: int | None = None
    max_size: int = 1200
    formats: tuple[str, ...] = ("usdc", "glb", "hair")
    turntable: bool = True
    settings: tuple[str, ...] = ()
    from_stage: str | None = None
    strokes: Path | None = None
    landmarks: Path | None = None
    depth_strokes: Path | None = None
    face: int | None = None


def run_portrait(options: PortraitOptions, *, report: Report) -> Delivery:
    """Reads the photo, reconstructs, delivers. Raises the errors of all three; then nothing was written."""
    params = _params(options)
    photo = _read(options, report)
    reconstruct(
        photo.pixels,
        alpha=photo.alpha,
        params=params,
        corrections=Corrections(),
        start_from=options.from_stage,
        cache=StageCache(options.folder / STAGES_FOLDER),
        report=report,
    )
    return Delivery(options.folder, ())


def _read(options: PortraitOptions, report: Report) -> Photo:
    with report.stage("read"):
        photo = read_photo(options.photo, max_size=options.max_size)
        for warning in photo.warnings:
            report.warn(warning)
        height, width = photo.pixels.shape[:2]
        report.number("width", width)
        report.number("height", height)
    return photo


def _params(options: PortraitOptions) -> PortraitParams:
    return with_settings(replace(PortraitParams(), seed=options.seed), options.settings)
