"""`tress keyframes`: motion for the strips of a file."""

from pathlib import Path
from typing import Annotated

import typer

from tress.app.exit_codes import guarded
from tress.app.param_option import param_option
from tress.methods.strips.motions import MOTIONS, MotionParams
from tress.model.tracks import INTERPOLATIONS

_MOTION = "Motion"
_SCREEN = "Screen"
_DEFAULT = MotionParams()


@guarded
def keyframes(
    file: Annotated[
        Path, typer.Argument(help="A file with strips that Tress reads, best a .usdc.", show_default=False)
    ],
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder for the results; made if absent.")] = Path(
        "out"
    ),
    motion: Annotated[
        str, typer.Option(help=f"Which motion: {' or '.join(MOTIONS)}.", metavar="NAME", rich_help_panel=_MOTION)
    ] = "sway",
    read: Annotated[
        Path | None, typer.Option("--from", help="Keyframes in JSON instead of a motion.", rich_help_panel=_MOTION)
    ] = None,
    target: Annotated[
        list[str] | None,
        typer.Option(help="A strip or group to move; again for more. All hair otherwise.", rich_help_panel=_MOTION),
    ] = None,
    clear: Annotated[
        bool, typer.Option("--clear", help="Take away the motions that the file has.", rich_help_panel=_MOTION)
    ] = False,
    amplitude: Annotated[
        float, param_option(MotionParams, "amplitude_m", panel=_MOTION, flag="--amplitude")
    ] = _DEFAULT.amplitude_m,
    period: Annotated[
        float, param_option(MotionParams, "period_secs", panel=_MOTION, flag="--period")
    ] = _DEFAULT.period_secs,
    direction: Annotated[float, param_option(MotionParams, "direction", panel=_MOTION)] = _DEFAULT.direction,
    stiffness: Annotated[float, param_option(MotionParams, "stiffness", panel=_MOTION)] = _DEFAULT.stiffness,
    variety: Annotated[float, param_option(MotionParams, "variety", panel=_MOTION)] = _DEFAULT.variety,
    wavelength: Annotated[
        float, param_option(MotionParams, "wavelength_m", panel=_MOTION, flag="--wavelength")
    ] = _DEFAULT.wavelength_m,
    interpolation: Annotated[
        str, typer.Option(help=f"Between keyframes: {', '.join(INTERPOLATIONS)}.", rich_help_panel=_MOTION)
    ] = _DEFAULT.interpolation,
    seed: Annotated[int, param_option(MotionParams, "seed", panel=_MOTION)] = _DEFAULT.seed,
    formats: Annotated[str, typer.Option(help="Files to write, by ending, with commas between.")] = "usdc,glb",
    style: Annotated[
        str,
        typer.Option(
            help="How preview and film are shaded: textured (strands), gouraud (plain strips, quicker), toon or photo.",
            metavar="NAME",
        ),
    ] = "textured",
    turntable: Annotated[bool, typer.Option(help="Also write the film turntable.webm, which plays the motion.")] = True,
    film: Annotated[
        str,
        typer.Option(help="Kinds of the film: webm, gif, mp4 (by your ffmpeg) or png (pictures), with commas between."),
    ] = "webm",
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
    """Give the strips of a file a motion: a sway, wind, or keyframes from JSON.

    The folder then holds hair.usdc (keyframes as records, and time samples), hair.glb (a clip), preview.png (moments of
    the motion), turntable.webm and report.json.

    [bold]Examples[/]

      tress keyframes hair.usdc -o out/

      tress keyframes hair.usdc -o out/ --motion wind --direction 90 --amplitude 0.03 --period 3

      tress keyframes hair.usdc -o out/ --from nod.json --clear
    """
    from tress.app.keyframes_job import KeyframesOptions, run_keyframes
    from tress.app.screen import screen

    params = MotionParams(
        amplitude_m=amplitude,
        period_secs=period,
        direction=direction,
        stiffness=stiffness,
        variety=variety,
        wavelength_m=wavelength,
        interpolation=interpolation,
        seed=seed,
    )
    options = KeyframesOptions(
        source=file,
        folder=output,
        motion=motion,
        read=read,
        targets=tuple(target or ()),
        params=params,
        clear=clear,
        formats=tuple(name.strip().lstrip(".").lower() for name in formats.split(",") if name.strip()),
        style=style,
        turntable=turntable,
        films=tuple(name.strip().lower() for name in film.split(",") if name.strip()),
    )
    with screen(verbose=verbose, quiet=quiet, json_output=json_output) as shown:
        shown.results(run_keyframes(options, report=shown.report))
