"""Every command line in the documentation and in the help is one that `tress` understands."""

import re
import shlex
from pathlib import Path

import pytest
from typer.main import get_command

from tress.app.cli import app
from tress.app.settings import with_settings
from tress.methods.portrait.params import PortraitParams

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
COMMANDS = get_command(app)


def lines_of_pages() -> list[tuple[str, str]]:
    """The command lines in the code blocks of all pages: the page, the line."""
    line = re.compile(r"^(?:    )?(?:\.venv/bin/)?(tress [a-z].*)$", re.M)
    return [(page.name, found) for page in PAGES for found in line.findall(page.read_text().replace("\\\n", " "))]


def lines_of_help() -> list[tuple[str, str]]:
    """Those in the help of every command."""
    line = re.compile(r"^ *(?:Example: +)?(tress [a-z].*)$", re.M)
    helps = {name: command.help or "" for name, command in COMMANDS.commands.items()}  # type: ignore[attr-defined]
    return [(name, found) for name, words in helps.items() for found in line.findall(words)]


LINES = [*lines_of_pages(), *lines_of_help()]


def test_there_are_command_lines_to_check():
    assert len(lines_of_pages()) > 5 and len(lines_of_help()) > 5


@pytest.mark.parametrize(("where", "line"), LINES, ids=[f"{where}: {line}" for where, line in LINES])
def test_a_documented_command_line_is_understood(where, line):
    name, *arguments = shlex.split(line.split(" #")[0])[1:]
    command = COMMANDS.commands[name]  # type: ignore[attr-defined]
    context = command.make_context(name, list(arguments))
    with_settings(PortraitParams(), context.params.get("set_") or ())
    stage = context.params.get("from_stage") or context.params.get("stage")
    assert stage is None or hasattr(PortraitParams(), stage) or stage == "layers"
