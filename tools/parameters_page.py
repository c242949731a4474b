"""Writes docs/parameters.md from the parameter dataclasses: `python -m tools.parameters_page`."""

from itertools import groupby
from pathlib import Path

from tress.app.settings import Setting, settings
from tress.methods.portrait.params import PortraitParams

PAGE = Path(__file__).parents[1] / "docs" / "parameters.md"
HEAD = """# Parameters

Every parameter of every stage of `tress portrait`, set by `--set stage.name=value`;
`tress params` shows the same table.
"""


def page() -> str:
    """The page in Markdown."""
    stages = groupby(settings(PortraitParams()), key=lambda row: row.name.split(".")[0])
    return HEAD + "".join(_section(stage, list(rows)) for stage, rows in stages)


def _section(stage: str, rows: list[Setting]) -> str:
    lines = [f"\n## {stage}\n", "| parameter | default | range | unit | what it does |", "|---|---|---|---|---|"]
    lines += [f"| `{row.name}` | {row.default} | {row.limits} | {row.unit} | {row.doc} |" for row in rows]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page())
