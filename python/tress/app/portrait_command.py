"""`tress portrait`: one photograph to hair."""

from pathlib import Path
from typing import Annotated

import typer

from tress.app.exit_codes import guarded

_CORRECT = "Correct and rerun"
_RESULT = "Result"
_SCREEN = "Screen"


@guarded
def portrait(
    photo: Annotated[
        Path, typer.Argument(help="The photograph: JPEG, PNG, WebP, TIFF …", metavar="PHOTO", show_default=False)
    ],
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for the results; made if absent.")] = Path(
        "out"
    ),
    seed: Annotated[
        int, typer.Option(min=0, help="Same photo, options and seed: the same bits.", rich_help_panel=_RESULT)
    ] = 0,
    strands: Annotated[
        int | None,
        typer.Option(
            min=100, max=1_000_000, help="How many strands to grow.", show_default="50000", rich_help_panel=_RESULT
        ),
    ] = None,
    max_size: Annotated[
        int,
        typer.Option(
            min=64, max=8192, help="Make the photo's longer side at most this many pixels.", rich_help_panel=_RESULT
        ),
    ] = 1200,
    formats: Annotated[
        str, typer.Option(help="Files to write, by ending, with commas between.", rich_help_panel=_RESULT)
    ] = "usdc,glb,hair",
    turntable: Annotated[
        bool, typer.Option(help="Also write the film turntable.webm.", rich_help_panel=_RESULT)
    ] = True,
    set_: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="STAGE.NAME=VALUE",
            help="Set one parameter of one stage; may be repeated. [cyan]tress params[/] lists them.",
            rich_help_panel=_RESULT,
        ),
    ] = None,
    from_stage: Annotated[
        str | None,
        typer.Option(
            metavar="STAGE",
            help="Keep the results of the stages before this one from the last run into the same folder.",
            rich_help_panel=_CORRECT,
        ),
    ] = None,
    strokes: Annotated[
        Path | None,
        typer.Option(
            help="Strokes that say which layer is where: JSON polylines or a picture.", rich_help_panel=_CORRECT
        ),
    ] = None,
    landmarks: Annotated[
        Path | None,
        typer.Option(
            help="JSON with the face's points or the eyes, where none or the wrong face is found.",
            rich_help_panel=_CORRECT,
        ),
    ] = None,
    depth_strokes: Annotated[
        Path | None, typer.Option(help="JSON with strokes of known depth.", rich_help_panel=_CORRECT)
    ] = None,
    face: Annotated[
        int | None,
        typer.Option(
            min=0, help="Which face, where there are several, from the left; 0 is the first.", rich_help_panel=_CORRECT
        ),
    ] = None,
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
    """Turn one portrait photograph into strand-based 3D hair on a fitted 3D head.

    The folder then holds hair.usdc, hair.glb and hair.hair, preview.png (the photo, the hair over it, from ±30° and
    from behind), turntable.webm, report.json, and stages/ with one picture for every step of the way.

    [bold]Examples[/]

      tress portrait me.jpg -o out/

      tress portrait me.jpg -o out/ --strands 10000 --formats usdc,glb,ply

      [dim]Look at out/stages/02_layers.png; if the cut is wrong there, draw over it and go on from that stage:[/]

      tress portrait me.jpg -o out/ --strokes strokes.json --from-stage layers

      tress portrait me.jpg -o out/ --set trace.min_length_px=12 --from-stage trace
    """
    from tress.app.screen import screen
    from tress.app.threads import limit_threads

    limit_threads(threads)
    from tress.app.portrait_job import PortraitOptions, run_portrait
    from tress.methods.portrait.corrections_files import CorrectionFiles

    options = PortraitOptions(
        photo=photo,
        folder=output,
        seed=seed,
        strands=strands,
        max_size=max_size,
        formats=tuple(name.strip().lstrip(".").lower() for name in formats.split(",") if name.strip()),
        turntable=turntable,
        settings=tuple(set_ or ()),
        from_stage=from_stage,
        corrections=CorrectionFiles(face, landmarks, strokes, depth_strokes),
    )
    with screen(verbose=verbose, quiet=quiet, json_output=json_output) as shown:
        shown.results(run_portrait(options, report=shown.report))
