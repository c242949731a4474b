"""`tress texture`: strand textures for strips from a few numbers."""

from pathlib import Path
from typing import Annotated

import typer

from tress.app.exit_codes import guarded
from tress.app.hex_color import hex_of_linear, linear_of_hex
from tress.app.param_option import param_option
from tress.render.textures.card_kinds import KINDS
from tress.render.textures.params import TextureParams

_HAIR = "Strands"
_COLOR = "Colour"
_ATLAS = "Atlas"
_SCREEN = "Screen"
_DEFAULT = TextureParams()


@guarded
def texture(
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for the results; made if absent.")] = Path(
        "out"
    ),
    strands: Annotated[int, param_option(TextureParams, "strands", panel=_HAIR)] = _DEFAULT.strands,
    thickness: Annotated[float, param_option(TextureParams, "thickness", panel=_HAIR)] = _DEFAULT.thickness,
    clumping: Annotated[float, param_option(TextureParams, "clumping", panel=_HAIR)] = _DEFAULT.clumping,
    frizz: Annotated[float, param_option(TextureParams, "frizz", panel=_HAIR)] = _DEFAULT.frizz,
    length_variation: Annotated[
        float, param_option(TextureParams, "length_variation", panel=_HAIR)
    ] = _DEFAULT.length_variation,
    tip_fade: Annotated[float, param_option(TextureParams, "tip_fade", panel=_HAIR)] = _DEFAULT.tip_fade,
    root_fade: Annotated[float, param_option(TextureParams, "root_fade", panel=_HAIR)] = _DEFAULT.root_fade,
    root_color: Annotated[
        str, typer.Option(help="Colour at the root, sRGB.", metavar="HEX", rich_help_panel=_COLOR)
    ] = hex_of_linear(_DEFAULT.root_color),
    tip_color: Annotated[
        str, typer.Option(help="Colour at the tip, sRGB.", metavar="HEX", rich_help_panel=_COLOR)
    ] = hex_of_linear(_DEFAULT.tip_color),
    color_variation: Annotated[
        float, param_option(TextureParams, "color_variation", panel=_COLOR)
    ] = _DEFAULT.color_variation,
    depth_shading: Annotated[
        float, param_option(TextureParams, "depth_shading", panel=_COLOR)
    ] = _DEFAULT.depth_shading,
    variations: Annotated[int, param_option(TextureParams, "variations", panel=_ATLAS)] = _DEFAULT.variations,
    kinds: Annotated[
        str,
        typer.Option(
            help=f"Kinds of card from the first variation to the last, with commas between: {', '.join(KINDS)}.",
            rich_help_panel=_ATLAS,
        ),
    ] = ",".join(_DEFAULT.kinds),
    resolution: Annotated[int, param_option(TextureParams, "resolution", panel=_ATLAS)] = _DEFAULT.resolution,
    aspect: Annotated[float, param_option(TextureParams, "aspect", panel=_ATLAS)] = _DEFAULT.aspect,
    padding: Annotated[int, param_option(TextureParams, "padding", panel=_ATLAS)] = _DEFAULT.padding,
    threshold: Annotated[float, param_option(TextureParams, "threshold", panel=_ATLAS)] = _DEFAULT.threshold,
    mips: Annotated[
        bool, typer.Option(help="Also write the smaller levels of every map, into mips/.", rich_help_panel=_ATLAS)
    ] = True,
    seed: Annotated[int, param_option(TextureParams, "seed", panel=_ATLAS)] = _DEFAULT.seed,
    threads: Annotated[
        int | None,
        typer.Option(min=1, help="Use at most this many cores; the result is the same.", rich_help_panel=_SCREEN),
    ] = None,
    verbose: Annotated[
        int,
        typer.Option(
            "-v", "--verbose", count=True, help="Say more; -vv shows where an error came from.", rich_help_panel=_SCREEN
        ),
    ] = 0,
    quiet: Annotated[
        bool, typer.Option("-q", "--quiet", help="Say nothing but errors.", rich_help_panel=_SCREEN)
    ] = False,
    json_output: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and nothing else.", rich_help_panel=_SCREEN)
    ] = False,
) -> None:
    """Draw strands for strips (hair cards): variations in one atlas, with every map that a hair shader asks for.

    The folder then holds color.png (straight alpha) and alpha, normal, flow, root_to_tip, depth, strand_id and
    ambient_occlusion beside it, mips/ with their smaller levels, atlas.json (where each variation lies), atlas.usdc
    (all of it as a document), preview.png and report.json.

    [bold]Examples[/]

      tress texture -o out/

      tress texture -o out/ --strands 60 --variations 8 --root-color "#5b4020" --tip-color "#d9b878"

      tress texture -o out/ --kinds core,wispy --resolution 4096 --frizz 0.7 --clumping 0.3
    """
    from tress.app.screen import screen
    from tress.app.threads import limit_threads

    limit_threads(threads)
    from tress.app.texture_job import TextureOptions, run_texture

    params = TextureParams(
        strands=strands,
        thickness=thickness,
        clumping=clumping,
        frizz=frizz,
        length_variation=length_variation,
        tip_fade=tip_fade,
        root_fade=root_fade,
        root_color=linear_of_hex(root_color),
        tip_color=linear_of_hex(tip_color),
        color_variation=color_variation,
        depth_shading=depth_shading,
        variations=variations,
        kinds=tuple(name.strip() for name in kinds.split(",") if name.strip()),
        resolution=resolution,
        aspect=aspect,
        padding=padding,
        threshold=threshold,
        seed=seed,
    )
    options = TextureOptions(output, params, mips=mips)
    with screen(verbose=verbose, quiet=quiet, json_output=json_output) as shown:
        shown.results(run_texture(options, report=shown.report))
