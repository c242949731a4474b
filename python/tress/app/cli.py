"""`tress`: the commands, one a file, and the few things that hold for all of them."""

import os
import sys
from typing import Annotated

import typer

from tress import __version__
from tress.app.cartoon_command import cartoon
from tress.app.convert_command import convert
from tress.app.exit_codes import INTERRUPTED
from tress.app.info_command import info
from tress.app.keyframes_command import keyframes
from tress.app.lod_command import lod
from tress.app.one_line_errors import OneLineErrors
from tress.app.params_command import params
from tress.app.portrait_command import portrait
from tress.app.strips_command import strips
from tress.app.texture_command import texture

EPILOG = (
    "Exit codes: 0 done · 1 a fault of Tress · 2 input that cannot be used · 3 the result could not be written · "
    "130 interrupted."
)

app = typer.Typer(
    name="tress",
    cls=OneLineErrors,
    help="Strand-based 3D hair from one portrait photograph, on an ordinary computer.",
    epilog=EPILOG,
    no_args_is_help=True,
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command()(portrait)
app.command()(strips)
app.command()(cartoon)
app.command()(texture)
app.command()(lod)
app.command()(keyframes)
app.command()(params)
app.command()(info)
app.command()(convert)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"tress {__version__}")
        raise typer.Exit


@app.callback()
def tress(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version and stop.", callback=_print_version, is_eager=True)
    ] = False,
) -> None:
    """Strand-based 3D hair from one portrait photograph, on an ordinary computer."""


def main() -> None:
    """Entry point of the `tress` script."""
    # Sums in a threaded BLAS depend on the number of threads; results here must not.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        app()
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
