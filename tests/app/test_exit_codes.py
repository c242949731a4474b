"""Whatever stops a command becomes one line and the exit code of its kind."""

import json

import pytest
import typer

from tress.app.exit_codes import guarded
from tress.base.errors import AssetMissingError, CancelledError, NoHairError, OutputError


def stopped_by(error: BaseException, **options) -> int:
    @guarded
    def command(verbose: int = 0, json_output: bool = False) -> None:
        raise error

    with pytest.raises(typer.Exit) as caught:
        command(**options)
    return caught.value.exit_code


@pytest.mark.parametrize(
    ("error", "code", "line"),
    [
        (NoHairError("No hair was found."), 2, "tress: No hair was found.\n"),
        (AssetMissingError("x is not built;\n run make assets."), 2, "tress: x is not built; run make assets.\n"),
        (OutputError("The disk is full."), 3, "tress: The disk is full.\n"),
        (CancelledError("Stopped."), 130, "tress: Stopped.\n"),
        (KeyboardInterrupt(), 130, "tress: interrupted; nothing was written.\n"),
    ],
)
def test_errors_become_one_line_and_a_code(capsys, error, code, line):
    assert stopped_by(error) == code
    assert capsys.readouterr().err == line


def test_faults_name_themselves_and_hide_their_traceback(capsys):
    assert stopped_by(ZeroDivisionError("division by zero")) == 1
    shown = capsys.readouterr().err
    assert "ZeroDivisionError" in shown
    assert "Traceback" not in shown
    assert stopped_by(ZeroDivisionError("division by zero"), verbose=2) == 1
    assert "Traceback" in capsys.readouterr().err


def test_json_holds_the_error(capsys):
    assert stopped_by(NoHairError("No hair was found."), json_output=True) == 2
    told = json.loads(capsys.readouterr().out)
    assert told == {"ok": False, "error": "No hair was found.", "kind": "NoHairError", "exit_code": 2}
