"""Motion for the strips of a file: the job that the command runs."""

from dataclasses import asdict, dataclass, field
from pathlib import Path

from PIL import Image

from tress.app.saved_document import opened
from tress.app.strip_formats import strip_formats
from tress.app.strips_job import style_of
from tress.base.errors import InputError
from tress.base.report import Report
from tress.edit.delete import delete
from tress.edit.keyframe import set_keyframes
from tress.io.atomic import OutputFolder
from tress.io.keyframes_json import read_keyframes_json
from tress.io.report_file import write_report
from tress.methods.strips.edited import edited
from tress.methods.strips.film import FilmParams, film_strip, moving_turntable
from tress.methods.strips.motions import MotionParams, motion_of
from tress.model.document import Document
from tress.model.group import Group
from tress.model.keyframes import Keyframes
from tress.model.strip import Strip
from tress.render.films import checked_films, write_films
from tress.render.style import Style


@dataclass(frozen=True)
class KeyframesOptions:
    """What the user asked for; the fields are those of `tress keyframes --help`."""

    source: Path
    folder: Path
    motion: str = "sway"
    read: Path | None = None
    targets: tuple[str, ...] = ()
    params: MotionParams = field(default_factory=MotionParams)
    clear: bool = False
    formats: tuple[str, ...] = ("usdc", "glb")
    style: str = "textured"
    turntable: bool = True
    films: tuple[str, ...] = ("webm",)


@dataclass(frozen=True)
class Delivery:
    """What was written: a folder and the files in it, relative to it."""

    folder: Path
    files: tuple[Path, ...]


def run_keyframes(options: KeyframesOptions, *, report: Report) -> Delivery:
    """Moves and delivers. Raises the errors of both; then nothing was written."""
    formats, style = strip_formats(options.formats), style_of(options.style)
    checked_films(options.films)
    with report.stage("read"):
        document = opened(options.source, report=report)
    with report.stage("keyframes"):
        document = moving(document, options)
        found = document.of_type(Keyframes)
        report.number("motions", len(found))
        report.number("moments", max((len(item.times) for item in found.values()), default=0))
    with OutputFolder(options.folder) as output:
        for name, form in formats.items():
            with report.stage(form.name):
                form.write(document, output.path / name)
        with report.stage("preview"):
            _write_pictures(document, options, output.path, style, report)
        facts = {"motion": str(options.read or options.motion), "parameters": asdict(options.params)}
        write_report(report, output.path / "report.json", facts=facts)
        files = tuple(sorted(file.relative_to(output.path) for file in output.path.rglob("*") if file.is_file()))
    return Delivery(options.folder, files)


def _write_pictures(document: Document, options: KeyframesOptions, folder: Path, style: Style, report: Report) -> None:
    Image.fromarray(film_strip(document, style=style)).save(folder / "preview.png", compress_level=4)
    if options.turntable:
        film = FilmParams()
        frames = moving_turntable(document, params=film, style=style, report=report)
        write_films(folder, name="turntable", kinds=options.films, frames=frames, frames_per_sec=film.frames_per_sec)


def moving(document: Document, options: KeyframesOptions) -> Document:
    """The document with the motions of the options, added to those that it has, or in place of them with `clear`."""
    if options.clear and (old := list(document.of_type(Keyframes))):
        document = edited(document, delete, names=old)
    for name, item in _motions(document, options).items():
        fields = {key: value for key, value in vars(item).items() if key != "target"}
        free = "" if name in document.records else name
        document = edited(document, set_keyframes, target=item.target, name=free, **fields)
    return document


def _motions(document: Document, options: KeyframesOptions) -> dict[str, Keyframes]:
    """The motions to add, by the names that their records get where these are free."""
    if options.read is not None:
        found = read_keyframes_json(options.read)
        return {f"motion_{number}": item for number, item in enumerate(found)}
    targets = options.targets or whole_hair(document)
    return motion_of(options.motion)(document, targets=targets, params=options.params)


def whole_hair(document: Document) -> tuple[str, ...]:
    """The groups and strips that lie in no group. Raises `InputError` where there are no strips."""
    if not document.of_type(Strip):
        raise InputError("The file holds no strips; keyframes move strips and their groups.")
    groups = [name for name, group in document.of_type(Group).items() if not group.parent]
    return (*groups, *(name for name, strip in document.of_type(Strip).items() if not strip.group))
