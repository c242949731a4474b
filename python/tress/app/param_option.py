"""Options of a command from the fields of a `Params` dataclass: default, range, unit and words are said only there."""

import dataclasses
from typing import Any

import typer


def param_option(params: type, name: str, *, panel: str, flag: str | None = None) -> Any:
    """The Typer option for one field of `params`; values out of range are refused by `params` itself, in one sentence.

    `flag` names the option where it is not the field's own name with dashes.
    """
    item = next(field for field in dataclasses.fields(params) if field.name == name)
    limits = item.metadata["range"]
    unit = f" {limits.unit}" if limits.unit else ""
    return typer.Option(
        *([flag] if flag else []),
        help=f"{limits.doc} [dim]\\[{limits.low:.10g} … {limits.high:.10g}{unit}][/]",
        rich_help_panel=panel,
    )
