"""Tables on standard output: whole on a terminal of any width, one line a row in a pipe."""

import sys
from collections.abc import Iterable, Sequence
from typing import Any

_WIDTH_IN_A_PIPE = 400


def print_table(heads: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Prints rows below their heads; nothing is cut off."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, header_style="bold")
    for head in heads:
        table.add_column(head, overflow="fold")
    for row in rows:
        table.add_row(*(Text(str(cell)) for cell in row))
    Console(width=None if sys.stdout.isatty() else _WIDTH_IN_A_PIPE).print(table)
