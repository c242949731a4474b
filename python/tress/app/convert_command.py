"""`tress convert`: a saved document into another format."""

from pathlib import Path
from typing import Annotated

import typer

from tress.app.exit_codes import guarded


@guarded
def convert(
    source: Annotated[Path, typer.Argument(help="A file that Tress wrote, best the .usdc.", show_default=False)],
    target: Annotated[Path, typer.Argument(help="The file to write; its ending says the format.", show_default=False)],
) -> None:
    """Write a saved document in another format. What that format cannot hold is left out.

    Example:  tress convert out/hair.usdc hair.ply
    """
    from tress.app.saved_document import opened
    from tress.io.formats.registry import format_of

    form = format_of(target)
    form.write(opened(source), target)
    typer.echo(f"{target} ({target.stat().st_size / 1e6:.1f} MB)")
