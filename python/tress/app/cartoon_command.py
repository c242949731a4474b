"""`tress cartoon`: a hairdo of clumps from a preset, or along surfaces of another program."""

from pathlib import Path
from typing import Annotated

import typer

from tress.app.exit_codes import guarded
from tress.app.hex_color import linear_of_hex
from tress.app.param_option import param_option
from tress.methods.cartoon.cartoon_params import CartoonParams

_HAIR = "Hairdo"
_MOTION = "Motion"
_RESULT = "Result"
_SCREEN = "Screen"
_DEFAULT = CartoonParams()


@guarded
def cartoon(
    preset: Annotated[
        str,
        typer.Option(
            help="Which hairdo: ponytail, long_wind, spiky, bob_bangs or twin_tails.",
            metavar="NAME",
            rich_help_panel=_HAIR,
        ),
    ] = "ponytail",
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for the results; made if absent.")] = Path(
        "out"
    ),
    surface: Annotated[
        Path | None,
        typer.Option(
            help="A USD file with NURBS patches (Maya, Houdini, Rhino): clumps grow along each, in place of a preset.",
            rich_help_panel=_HAIR,
        ),
    ] = None,
    clumps: Annotated[float, param_option(CartoonParams, "clumps", panel=_HAIR)] = _DEFAULT.clumps,
    length: Annotated[float, param_option(CartoonParams, "length", panel=_HAIR)] = _DEFAULT.length,
    pointiness: Annotated[float, param_option(CartoonParams, "pointiness", panel=_HAIR)] = _DEFAULT.pointiness,
    color: Annotated[
        str, typer.Option(help="Colour of the hair, sRGB.", metavar="HEX", rich_help_panel=_HAIR)
    ] = "#a0653a",
    head: Annotated[
        Path | None,
        typer.Option(
            help="A document with a fitted head, such as hair.usdc of [cyan]tress portrait[/]; else the built-in one.",
            rich_help_panel=_HAIR,
        ),
    ] = None,
    seed: Annotated[int, param_option(CartoonParams, "seed", panel=_HAIR)] = _DEFAULT.seed,
    simulate: Annotated[
        bool, typer.Option("--simulate", help="Let the clumps swing as the head moves.", rich_help_panel=_MOTION)
    ] = False,
    head_motion: Annotated[
        str,
        typer.Option(
            help="How the head moves: turn, shake, nod, walk or still.", metavar="NAME", rich_help_panel=_MOTION
        ),
    ] = "turn",
    style: Annotated[
        str,
        typer.Option(
            help="How pictures are shaded: toon (flat tones, outlines) or gouraud (smooth).",
            metavar="NAME",
            rich_help_panel=_RESULT,
        ),
    ] = "toon",
    formats: Annotated[
        str, typer.Option(help="Files to write, by ending, with commas between.", rich_help_panel=_RESULT)
    ] = "usdc,glb",
    turntable: Annotated[
        bool, typer.Option(help="Also write the film turntable.webm.", rich_help_panel=_RESULT)
    ] = False,
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
    """Make cartoon hair: clumps swept along NURBS surfaces that lie over the built-in head, or a fitted one.

    The folder then holds hair.usdc (clumps as NURBS patches, with the mesh beside them, and the surfaces they follow),
    hair.glb, preview.png (five sides and from above), stills, report.json, and turntable.webm where asked for.

    [bold]Examples[/]

      tress cartoon --preset ponytail --simulate --head-motion turn --turntable -o out/

      tress cartoon --preset spiky --color "#d8b13a" --clumps 1.3 -o out/

      tress cartoon --surface hairdo.usda -o out/
    """
    from tress.app.screen import screen
    from tress.app.threads import limit_threads

    limit_threads(threads)
    from tress.app.cartoon_job import CartoonOptions, run_cartoon

    options = CartoonOptions(
        preset=preset,
        folder=output,
        params=CartoonParams(clumps=clumps, length=length, pointiness=pointiness, seed=seed),
        color=linear_of_hex(color),
        head=head,
        surfaces=surface,
        simulate=simulate,
        head_motion=head_motion,
        style=style,
        formats=tuple(name.strip().lstrip(".").lower() for name in formats.split(",") if name.strip()),
        turntable=turntable,
    )
    with screen(verbose=verbose, quiet=quiet, json_output=json_output) as shown:
        shown.results(run_cartoon(options, report=shown.report))
