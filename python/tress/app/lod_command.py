"""`tress lod`: levels of detail of strips for games."""

from pathlib import Path
from typing import Annotated

import typer

from tress.app.exit_codes import guarded
from tress.app.param_option import param_option
from tress.io.strip_glb import CardParams
from tress.methods.strips.levels import LevelParams

_LEVELS = "Levels"
_FILES = "Files"
_SCREEN = "Screen"
_DEFAULT = LevelParams()
_CARDS = CardParams()


@guarded
def lod(
    file: Annotated[
        Path, typer.Argument(help="A file with strips that Tress reads, best a .usdc.", show_default=False)
    ],
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for the results; made if absent.")] = Path(
        "out"
    ),
    budgets: Annotated[
        str, typer.Option("--lod", help="Triangles of every level, falling, with commas between.", metavar="N,N,…")
    ] = "20000,8000,2000",
    least_polygons: Annotated[
        int, param_option(LevelParams, "least_polygons", panel=_LEVELS)
    ] = _DEFAULT.least_polygons,
    keep_all: Annotated[
        bool, typer.Option("--keep-all", help="Every strip stays on every level.", rich_help_panel=_LEVELS)
    ] = False,
    widest: Annotated[float, param_option(LevelParams, "widest", panel=_LEVELS)] = _DEFAULT.widest,
    pixels: Annotated[float, param_option(LevelParams, "pixels", panel=_LEVELS)] = _DEFAULT.pixels,
    picture_height: Annotated[
        int, param_option(LevelParams, "picture_height", panel=_LEVELS)
    ] = _DEFAULT.picture_height,
    field_of_view: Annotated[float, param_option(LevelParams, "field_of_view", panel=_LEVELS)] = _DEFAULT.field_of_view,
    padding: Annotated[int, param_option(LevelParams, "padding", panel=_LEVELS)] = _DEFAULT.padding,
    alpha: Annotated[
        str, typer.Option(help="Transparency: mask (an alpha test) or blend.", rich_help_panel=_FILES)
    ] = _CARDS.alpha,
    threshold: Annotated[float, param_option(CardParams, "threshold", panel=_FILES)] = _CARDS.threshold,
    measure: Annotated[
        bool, typer.Option(help="Compare every level with the first, where it takes over.", rich_help_panel=_FILES)
    ] = True,
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
    """Make levels of detail of strips, to budgets of triangles, as GLB.

    The folder then holds hair.glb (all levels, MSFT_lod, with the head), hair_lod0.glb … (a level each), lod.json (the
    distance at which each level takes over, and how it compares), preview.png and report.json. Keyframes become a clip.

    [bold]Examples[/]

      tress lod hair.usdc -o out/ --lod 20000,8000,2000

      tress lod hair.usdc -o out/ --lod 6000,1500 --alpha blend --field-of-view 60
    """
    from tress.app.screen import screen
    from tress.app.threads import limit_threads

    limit_threads(threads)
    from tress.app.lod_job import LodOptions, run_lod
    from tress.app.triangle_budgets import triangle_budgets

    levels = LevelParams(
        least_polygons=least_polygons,
        keep_all=keep_all,
        widest=widest,
        pixels=pixels,
        picture_height=picture_height,
        field_of_view=field_of_view,
        threshold=threshold,
        padding=padding,
    )
    cards = CardParams(alpha=alpha, threshold=threshold)
    options = LodOptions(file, output, triangle_budgets(budgets), levels, cards, measure=measure)
    with screen(verbose=verbose, quiet=quiet, json_output=json_output) as shown:
        shown.results(run_lod(options, report=shown.report))
