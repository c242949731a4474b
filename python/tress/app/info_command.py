"""`tress info`: what a saved document holds."""

from pathlib import Path
from typing import Annotated, Any

import typer

from tress.app.exit_codes import guarded


@guarded
def info(
    file: Annotated[Path, typer.Argument(help="A file that Tress wrote.", show_default=False)],
    json_output: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Say what a saved document holds: its records, their sizes, and the parameters that it was made with.

    Example:  tress info out/hair.usdc
    """
    from tress.app.saved_document import opened

    records = {name: _summary(record) for name, record in opened(file).records.items()}
    if json_output:
        import json

        typer.echo(json.dumps(records, indent=2))
    else:
        _print_table(records)


def _summary(record: Any) -> dict[str, Any]:
    """The record's type, plain values, and shapes of its arrays, under dotted names."""
    import dataclasses
    from collections.abc import Mapping

    import numpy as np

    summary: dict[str, Any] = {"type": type(record).__name__}
    for field in dataclasses.fields(record):
        value = getattr(record, field.name)
        if isinstance(value, np.ndarray):
            summary[field.name] = f"{value.dtype.name} {' x '.join(map(str, value.shape))}"
        elif dataclasses.is_dataclass(value):
            summary |= {f"{field.name}.{name}": words for name, words in _summary(value).items()}
        elif isinstance(value, Mapping):
            summary |= {f"{field.name}.{name}": _words(item) for name, item in value.items()}
        elif value is not None:
            summary[field.name] = value
    return summary


def _words(value: Any) -> Any:
    shape = getattr(value, "shape", None)
    return value if shape is None else f"{value.dtype.name} {' x '.join(map(str, shape))}"


def _print_table(records: dict[str, dict[str, Any]]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table("record", "holds", "", box=None, pad_edge=False)
    for name, summary in records.items():
        for index, (part, words) in enumerate(summary.items()):
            table.add_row(name if index == 0 else "", part, str(words))
    Console().print(table)
