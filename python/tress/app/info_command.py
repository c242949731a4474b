"""`tress info`: what a saved file holds."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from tress.app.exit_codes import guarded

_RECORDS_SHOWN = 12


@guarded
def info(
    file: Annotated[Path, typer.Argument(help="A file that Tress wrote, best the .usdc.", show_default=False)],
    verbose: Annotated[
        int, typer.Option("-v", "--verbose", count=True, help="Show every record with all fields and parameters.")
    ] = 0,
    json_output: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Say what a saved file holds: strips, strands, head, camera, and the parameters that they were made with.

    Of a .glb, which keeps no records, it tells meshes, clips and pictures.

    Examples:

      tress info out/hair.usdc

      tress info out/hair.usdc -v
    """
    from tress.app.saved_document import opened
    from tress.io.formats.registry import format_of

    if file.suffix.lower() == ".glb":
        _tell_glb(file, json_output=json_output)
        return
    records = opened(file).records
    facts = {"format": format_of(file).name, "bytes": file.stat().st_size}
    if json_output:
        import json

        fields = {name: _fields(record) for name, record in records.items()}
        typer.echo(json.dumps({"ok": True, "file": str(file), **facts, "records": fields}))
    else:
        typer.echo(f"{file}: {facts['format']}, {facts['bytes'] / 1e6:.1f} MB")
        _print_fields(records) if verbose else _print_lines(records)


def _tell_glb(file: Path, *, json_output: bool) -> None:
    import json
    from dataclasses import asdict

    from tress.app.tables import print_table
    from tress.io.glb_summary import glb_summary

    parts = glb_summary(file)
    size = file.stat().st_size
    if json_output:
        found = {"ok": True, "file": str(file), "format": "glb", "bytes": size, "parts": [asdict(p) for p in parts]}
        typer.echo(json.dumps(found))
    else:
        typer.echo(f"{file}: glb, {size / 1e6:.1f} MB")
        print_table(["part", "type", "holds"], [(part.name, part.kind, part.holds) for part in parts])


def _print_lines(records: Mapping[str, Any]) -> None:
    """One line a record; of very many records of a type one line for all."""
    from tress.app.record_words import many_words, record_words
    from tress.app.tables import print_table

    kinds: dict[type, list[str]] = {}
    for name, record in records.items():
        kinds.setdefault(type(record), []).append(name)
    rows = []
    for kind, names in kinds.items():
        if len(names) > _RECORDS_SHOWN:
            rows.append((f"{names[0]} …", kind.__name__, many_words([records[name] for name in names])))
        else:
            rows += [(name, kind.__name__, record_words(records[name])) for name in names]
    print_table(["record", "type", "holds"], rows)


def _print_fields(records: Mapping[str, Any]) -> None:
    from tress.app.tables import print_table

    rows = []
    for name, record in records.items():
        fields = _fields(record)
        names = [name, *[""] * (len(fields) - 1)]
        rows += [(first, field, words) for first, (field, words) in zip(names, fields.items(), strict=True)]
    print_table(["record", "field", "value"], rows)


def _fields(record: Any) -> dict[str, Any]:
    """The record's type, plain values, and shapes of its arrays, under dotted names."""
    import dataclasses

    fields: dict[str, Any] = {"type": type(record).__name__}
    for field in dataclasses.fields(record):
        value = getattr(record, field.name)
        if dataclasses.is_dataclass(value):
            fields |= {f"{field.name}.{name}": words for name, words in _fields(value).items()}
        elif isinstance(value, Mapping):
            fields |= {f"{field.name}.{name}": _words(item) for name, item in value.items()}
        elif value is not None:
            fields[field.name] = _words(value)
    return fields


def _words(value: Any) -> Any:
    """A plain value as it is; of an array its type and shape."""
    shape = getattr(value, "shape", None)
    return value if shape is None else f"{value.dtype.name} {' x '.join(map(str, shape))}"
