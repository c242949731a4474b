"""`tress params`: every parameter of every stage."""

from typing import Annotated

import typer

from tress.app.exit_codes import guarded


@guarded
def params(
    stage: Annotated[str | None, typer.Argument(help="Show the parameters of this stage only.")] = None,
    json_output: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """List the parameters that [bold]tress portrait --set stage.name=value[/] understands.

    Example:  tress params depth
    """
    from tress.app.settings import settings, suggestion
    from tress.base.errors import ParameterError
    from tress.methods.portrait.params import PortraitParams

    found = list(settings(PortraitParams()))
    stages = sorted({row.name.split(".")[0] for row in found if "." in row.name})
    rows = [row for row in found if stage is None or row.name.split(".")[0] == stage]
    if not rows:
        raise ParameterError(f"{stage} is no stage with parameters;{suggestion(str(stage), stages)}")
    if json_output:
        import json

        typer.echo(json.dumps([vars(row) for row in rows], indent=2))
    else:
        from tress.app.tables import print_table

        heads = ["parameter", "default", "range", "unit", "what it does"]
        print_table(heads, [(row.name, row.default, row.limits, row.unit, row.doc) for row in rows])
