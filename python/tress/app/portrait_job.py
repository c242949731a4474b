"""One photograph to one folder: the job that the command runs, and that a batch can run many of."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from tress.app.settings import settings, with_settings
from tress.base.report import Report
from tress.io.atomic import OutputFolder
from tress.io.format import Format
from tress.io.formats.registry import format_of
from tress.io.photo import Photo, read_photo
from tress.io.stage_cache import StageCache
from tress.methods.portrait.corrections_files import CorrectionFiles, read_corrections
from tress.methods.portrait.delivery import STAGES_FOLDER, deliver
from tress.methods.portrait.params import PortraitParams
from tress.methods.portrait.pipeline import reconstruct


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
    corrections: CorrectionFiles = field(default_factory=CorrectionFiles)


@dataclass(frozen=True)
class Delivery:
    """What was written: a folder and the files in it, relative to it."""

    folder: Path
    files: tuple[Path, ...]


def run_portrait(options: PortraitOptions, *, report: Report) -> Delivery:
    """Reads the photo, reconstructs, delivers. Raises the errors of all three; then nothing was written."""
    formats = {f"hair.{ending}": format_of(Path(f"hair.{ending}")) for ending in options.formats}
    params = _params(options)
    photo = _read(options, report)
    with OutputFolder(options.folder) as output:
        reconstruction = reconstruct(
            photo.pixels,
            alpha=photo.alpha,
            params=params,
            corrections=read_corrections(options.corrections, photo=photo),
            start_from=options.from_stage,
            cache=StageCache(options.folder / STAGES_FOLDER),
            report=report,
        )
        facts = _facts(options, photo, params)
        deliver(reconstruction, output.path, formats=formats, turntable=options.turntable, facts=facts, report=report)
        files = tuple(sorted(file.relative_to(output.path) for file in output.path.rglob("*") if file.is_file()))
    _remove_stale(options.folder, formats, kept=files)
    return Delivery(options.folder, files)


def _remove_stale(folder: Path, formats: Mapping[str, Format], *, kept: tuple[Path, ...]) -> None:
    """Removes what an earlier run wrote beside these files for them, and nothing else."""
    for name, form in formats.items():
        for file in form.companions(folder / name):
            if file.relative_to(folder) not in kept:
                file.unlink(missing_ok=True)


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
    params = replace(PortraitParams(), seed=options.seed)
    if options.strands is not None:
        params = replace(params, strands=replace(params.strands, count=options.strands))
    return with_settings(params, options.settings)


def _facts(options: PortraitOptions, photo: Photo, params: PortraitParams) -> dict[str, Any]:
    """What the report says of the job: the photo, the seed, the corrections and every parameter."""
    return {
        "photo": {
            "file": photo.path.name,
            "original_size": [photo.original_width, photo.original_height],
            "size": [photo.pixels.shape[1], photo.pixels.shape[0]],
        },
        "seed": params.seed,
        "from_stage": options.from_stage,
        "corrections": {name: str(value) for name, value in vars(options.corrections).items() if value is not None},
        "parameters": {row.name: row.default for row in settings(params)},
    }
