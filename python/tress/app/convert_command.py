"""`tress convert`: a saved file into another format."""

from pathlib import Path
from typing import Annotated

import typer

from tress.app.exit_codes import guarded


@guarded
def convert(
    source: Annotated[Path, typer.Argument(help="A file that Tress wrote, best the .usdc.", show_default=False)],
    target: Annotated[Path, typer.Argument(help="The file to write; its ending says the format.", show_default=False)],
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Say nothing but errors.")] = False,
    json_output: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Write a saved file in another format. What that format cannot hold is left out.

    Read are .usdc, .usda, .usd, .hair, .ply, .obj and .npz; written are these and .glb. Strips go into .usdc, .glb and
    .obj; the others hold strands alone.

    Examples:

      tress convert out/hair.usdc hair.ply

      tress convert out/hair.usdc out/copy.usda
    """
    from tress.app.saved_document import opened
    from tress.io.formats.registry import format_of

    form = format_of(target)
    form.write(opened(source), target)
    size = target.stat().st_size
    if json_output:
        import json

        typer.echo(json.dumps({"ok": True, "file": str(target), "format": form.name, "bytes": size}))
    elif not quiet:
        typer.echo(f"{target} ({size / 1e6:.1f} MB)")
