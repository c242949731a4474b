"""`tress strips`: a hairdo of strips from a preset."""

from pathlib import Path
from typing import Annotated

import typer

from tress.app.exit_codes import guarded
from tress.app.hex_color import linear_of_hex
from tress.app.param_option import param_option
from tress.methods.strips.params import StripsParams

_HAIR = "Hairdo"
_RESULT = "Result"
_SCREEN = "Screen"
_DEFAULT = StripsParams()


@guarded
def strips(
    preset: Annotated[
        str,
        typer.Option(
            help="Which hairdo: long_straight, bob, short_crop, side_parting, wavy_shoulder or ponytail.",
            metavar="NAME",
            rich_help_panel=_HAIR,
        ),
    ] = "bob",
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for the results; made if absent.")] = Path(
        "out"
    ),
    count: Annotated[int, param_option(StripsParams, "strips", panel=_HAIR, flag="--strips")] = _DEFAULT.strips,
    length: Annotated[float, param_option(StripsParams, "length", panel=_HAIR)] = _DEFAULT.length,
    color: Annotated[
        str, typer.Option(help="Colour of the hair, sRGB.", metavar="HEX", rich_help_panel=_HAIR)
    ] = "#53361f",
    head: Annotated[
        Path | None,
        typer.Option(
            help="A document with a fitted head, such as hair.usdc of [cyan]tress portrait[/]; else the built-in one.",
            rich_help_panel=_HAIR,
        ),
    ] = None,
    seed: Annotated[int, param_option(StripsParams, "seed", panel=_HAIR)] = _DEFAULT.seed,
    style: Annotated[
        str,
        typer.Option(
            help="How pictures are shaded: textured (strands), gouraud (plain strips), toon (drawn) or photo (unlit).",
            metavar="NAME",
            rich_help_panel=_RESULT,
        ),
    ] = "textured",
    formats: Annotated[
        str, typer.Option(help="Files to write, by ending, with commas between.", rich_help_panel=_RESULT)
    ] = "usdc,glb",
    turntable: Annotated[
        bool, typer.Option(help="Also write the film turntable.webm.", rich_help_panel=_RESULT)
    ] = True,
    film: Annotated[
        str,
        typer.Option(
            help="Kinds of the film: webm, gif, mp4 (by your ffmpeg) or png (pictures), with commas between.",
            rich_help_panel=_RESULT,
        ),
    ] = "webm",
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
    """Grow a hairdo of strips (hair cards) on the built-in head, or on a fitted one.

    The folder then holds hair.usdc (strips as NURBS patches, with the mesh beside them), hair.glb, preview.png (five
    sides and from above), turntable.webm and report.json.

    [bold]Examples[/]

      tress strips --preset bob -o out/

      tress strips --preset ponytail --color "#a5793f" --length 1.3 --strips 400 -o out/

      tress strips --preset short_crop --head portrait/hair.usdc --no-turntable -o out/
    """
    from tress.app.screen import screen
    from tress.app.threads import limit_threads

    limit_threads(threads)
    from tress.app.strips_job import StripsOptions, run_strips

    options = StripsOptions(
        preset=preset,
        folder=output,
        params=StripsParams(strips=count, length=length, seed=seed),
        color=linear_of_hex(color),
        head=head,
        style=style,
        formats=tuple(name.strip().lstrip(".").lower() for name in formats.split(",") if name.strip()),
        turntable=turntable,
        films=tuple(name.strip().lower() for name in film.split(",") if name.strip()),
    )
    with screen(verbose=verbose, quiet=quiet, json_output=json_output) as shown:
        shown.results(run_strips(options, report=shown.report))
