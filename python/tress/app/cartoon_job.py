"""One cartoon hairdo to one folder: the job that the command runs."""

import dataclasses
import math
from dataclasses import dataclass, field
from pathlib import Path

from PIL import Image

from tress.app.saved_document import opened
from tress.app.strips_job import Delivery, fitted_head, style_of, write_format
from tress.base.errors import InputError
from tress.base.report import Report
from tress.dynamics.head_motion import head_motion_of
from tress.io.atomic import OutputFolder
from tress.io.formats.registry import format_of
from tress.io.report_file import write_report
from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.foreign_surfaces import hairdo_of_surfaces
from tress.methods.cartoon.hairdo import hairdo
from tress.methods.cartoon.motion import simulated
from tress.methods.strips.appearance import Color, for_style, preview, strips_scene, view
from tress.methods.strips.film import FilmParams, moving_turntable
from tress.model.document import Document
from tress.render.films import checked_films, write_films
from tress.render.occlusion import prepared
from tress.render.outline import OutlineParams
from tress.render.style import Style
from tress.render.styles.toon import ToonStyle
from tress.render.views import framed

COPPER: Color = (0.35, 0.13, 0.04)
STILLS = (("front", 0.0), ("side", 90.0), ("back", 180.0), ("quarter", 40.0))
STILL_PX = 900


@dataclass(frozen=True)
class CartoonOptions:
    """What the user asked for; the fields are those of `tress cartoon --help`."""

    preset: str
    folder: Path
    params: CartoonParams = field(default_factory=CartoonParams)
    color: Color = COPPER
    head: Path | None = None
    surfaces: Path | None = None
    simulate: bool = False
    head_motion: str = "turn"
    style: str = "toon"
    formats: tuple[str, ...] = ("usdc", "glb")
    turntable: bool = False
    films: tuple[str, ...] = ("webm",)


def run_cartoon(options: CartoonOptions, *, report: Report) -> Delivery:
    """Makes the hairdo and delivers it. Raises the errors of both; then nothing was written."""
    style, head_motion = clump_style(options.style), head_motion_of(options.head_motion)
    films = checked_films(options.films)
    formats = {f"hair.{ending}": format_of(Path(f"hair.{ending}")) for ending in options.formats}
    document = _made(options, report)
    if options.simulate:
        document = simulated(document, head_motion=head_motion, report=report)
    with OutputFolder(options.folder) as output:
        with report.stage("formats"):
            for name, form in formats.items():
                write_format(form, document, output.path / name, style=style, color=options.color)
        with report.stage("preview"):
            _write_pictures(document, options, style, output.path)
        if options.turntable:
            with report.stage("turntable"):
                film = FilmParams(frames_per_sec=24.0)
                frames = moving_turntable(
                    document,
                    params=film,
                    color=options.color,
                    style=style,
                    head_motion=head_motion if options.simulate else None,
                    report=report,
                )
                write_films(
                    output.path, name="turntable", kinds=films, frames=frames, frames_per_sec=film.frames_per_sec
                )
        facts = {"preset": options.preset, "parameters": dataclasses.asdict(options.params)}
        write_report(report, output.path / "report.json", facts=facts)
        files = tuple(sorted(file.relative_to(output.path) for file in output.path.rglob("*") if file.is_file()))
    return Delivery(options.folder, files)


def clump_style(name: str) -> Style:
    """The style of that name; drawn hair keeps lines between clumps, which lie closer than strips."""
    if name == ToonStyle.name:
        return ToonStyle(meld=0.45, lines=OutlineParams(step_m=0.0025, least_px=12.0))
    return style_of(name)


def _made(options: CartoonOptions, report: Report) -> Document:
    head = None if options.head is None else fitted_head(options.head)
    if options.surfaces is None:
        return hairdo(options.preset, params=options.params, head=head, report=report)
    if not options.surfaces.exists():
        raise InputError(f"{options.surfaces} is not there; a USD file with NURBS patches was expected.")
    return hairdo_of_surfaces(opened(options.surfaces), params=options.params, head=head, report=report)


def _write_pictures(document: Document, options: CartoonOptions, style: Style, folder: Path) -> None:
    picture = preview(document, color=options.color, style=style)
    Image.fromarray(picture).save(folder / "preview.png", compress_level=4)
    scene = prepared(strips_scene(document, color=options.color, **for_style(style)))
    camera = framed(scene, width=round(0.8 * STILL_PX), height=STILL_PX)
    for name, azimuth in STILLS:
        still = view(scene, camera, style=style, azimuth_rad=math.radians(azimuth))
        Image.fromarray(still).save(folder / f"{name}.png", compress_level=4)
