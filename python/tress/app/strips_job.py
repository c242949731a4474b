"""One hairdo to one folder: the job that the command runs."""

import dataclasses
from dataclasses import dataclass, field
from pathlib import Path

from PIL import Image

from tress.app.hex_color import hex_of_linear
from tress.app.saved_document import opened
from tress.app.strip_formats import strip_formats
from tress.base.errors import InputError
from tress.base.report import Report
from tress.io.atomic import OutputFolder, write_bytes
from tress.io.format import Format
from tress.io.report_file import write_report
from tress.io.toon_glb import encode_toon_glb
from tress.methods.strips.appearance import BROWN, Color, for_style, preview, strips_scene
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.hairdo import hairdo
from tress.methods.strips.painted_head import SKIN, painted
from tress.methods.strips.params import StripsParams
from tress.methods.strips.presets.registry import preset_of
from tress.model.document import Document
from tress.model.head import Head
from tress.model.recipe import Recipe
from tress.render.films import checked_films, write_films
from tress.render.style import Style
from tress.render.styles import STYLES
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_atlas import strand_atlas
from tress.render.turntable import turntable

ATLAS_PX, ROOT_SHADE, TIP_LIGHT = 1024, 0.75, 1.25


@dataclass(frozen=True)
class StripsOptions:
    """What the user asked for; the fields are those of `tress strips --help`."""

    preset: str
    folder: Path
    params: StripsParams = field(default_factory=StripsParams)
    color: Color = BROWN
    head: Path | None = None
    style: str = "textured"
    formats: tuple[str, ...] = ("usdc", "glb")
    turntable: bool = True
    films: tuple[str, ...] = ("webm",)


@dataclass(frozen=True)
class Delivery:
    """What was written: a folder and the files in it, relative to it."""

    folder: Path
    files: tuple[Path, ...]


def run_strips(options: StripsOptions, *, report: Report) -> Delivery:
    """Grows the hairdo and delivers it. Raises the errors of both; then nothing was written."""
    preset_of(options.preset)
    style, films = style_of(options.style), checked_films(options.films)
    formats = strip_formats(options.formats)
    head = None if options.head is None else fitted_head(options.head)
    with report.stage("strands"):
        atlas = strand_atlas(texture_params(options), report=report)
    document = hairdo(options.preset, params=options.params, atlas=atlas, head=head, report=report)
    document = with_color(document, color=options.color)
    with OutputFolder(options.folder) as output:
        with report.stage("formats"):
            for name, form in formats.items():
                write_format(form, document, output.path / name, style=style, color=options.color)
        with report.stage("preview"):
            picture = preview(document, color=options.color, style=style)
            Image.fromarray(picture).save(output.path / "preview.png", compress_level=4)
        if options.turntable:
            with report.stage("turntable"):
                scene = strips_scene(document, color=options.color, **for_style(style))
                frames = turntable(scene, style=style, report=report)
                write_films(output.path, name="turntable", kinds=films, frames=frames)
        parameters = {**dataclasses.asdict(options.params), "color": hex_of_linear(options.color)}
        facts = {"preset": options.preset, "parameters": parameters}
        write_report(report, output.path / "report.json", facts=facts)
        files = tuple(sorted(file.relative_to(output.path) for file in output.path.rglob("*") if file.is_file()))
    return Delivery(options.folder, files)


def write_format(form: Format, document: Document, path: Path, *, style: Style, color: Color) -> None:
    """Writes the document; a GLB of drawn hair has ramps and inverted hulls."""
    if form.name == "glb" and style.name == "toon":
        write_bytes(path, encode_toon_glb(document, color=color, skin=SKIN))
    else:
        form.write(document, path)


def style_of(name: str) -> Style:
    """The style of that name with its settings as they come. Raises `InputError` that names them all."""
    known = {style.name: style for style in STYLES}
    if name not in known:
        raise InputError(f"There is no style {name!r}; one of {', '.join(known)} was expected.")
    return known[name]()


def with_color(document: Document, *, color: Color) -> Document:
    """The document with its head painted for hair of that colour (linear), which its recipe then names."""
    records = dict(painted(document, color=color).records)
    for name, recipe in document.of_type(Recipe).items():
        records[name] = dataclasses.replace(recipe, parameters={**recipe.parameters, "color": hex_of_linear(color)})
    return Document(records)


def texture_params(options: StripsOptions) -> TextureParams:
    """Strands in the colour of the hair: darker at the root, lighter at the tip."""
    red, green, blue = (min(value * TIP_LIGHT, 1.0) for value in options.color)
    root = (options.color[0] * ROOT_SHADE, options.color[1] * ROOT_SHADE, options.color[2] * ROOT_SHADE)
    return TextureParams(resolution=ATLAS_PX, root_color=root, tip_color=(red, green, blue), seed=options.params.seed)


def fitted_head(path: Path) -> Document:
    """The head of a saved document, alone. Raises `InputError` where it has none, or no mask of its scalp."""
    record = opened(path).records.get(HEAD)
    if not isinstance(record, Head) or "scalp" not in record.mesh.vertex_attributes:
        raise InputError(f"{path} holds no head with a scalp; name the hair.usdc of `tress portrait`.")
    return Document({HEAD: record})
