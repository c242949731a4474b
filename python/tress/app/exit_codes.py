"""Errors become one line on standard error and an exit code; here and nowhere else."""

import functools
import json
import signal
import sys
import traceback
from collections.abc import Callable
from types import FrameType
from typing import Any

import typer

from tress.base.errors import CancelledError, OutputError, TressError

DONE, FAULT, BAD_INPUT, CANNOT_WRITE, INTERRUPTED = 0, 1, 2, 3, 130
_VERBOSE_FOR_TRACEBACK = 2


def exit_code(error: BaseException) -> int:
    """The code of the process for what stopped it."""
    if isinstance(error, CancelledError | KeyboardInterrupt):
        return INTERRUPTED
    if isinstance(error, OutputError):
        return CANNOT_WRITE
    return BAD_INPUT if isinstance(error, TressError) else FAULT


def error_line(error: BaseException) -> str:
    """What stopped the work, in one line."""
    if isinstance(error, KeyboardInterrupt):
        return "interrupted; nothing was written."
    if isinstance(error, TressError):
        return " ".join(str(error).split())
    words = " ".join(str(error).split())
    return f"this is a fault of Tress: {type(error).__name__}: {words}; -vv shows where, please report it."


def guarded(command: Callable[..., None]) -> Callable[..., None]:
    """The command with every exception turned into a line and an exit code.

    The command's options `verbose` and `json_output`, where it has them, decide on the traceback and on an error
    object on standard output.
    """

    @functools.wraps(command)
    def run(*arguments: Any, **options: Any) -> None:
        signal.signal(signal.SIGTERM, _interrupt)
        try:
            command(*arguments, **options)
        except (typer.Exit, typer.Abort):
            raise
        except (Exception, KeyboardInterrupt) as error:
            _tell(error, verbose=options.get("verbose", 0), as_json=options.get("json_output", False))
            raise typer.Exit(exit_code(error)) from None

    return run


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def _tell(error: BaseException, *, verbose: int, as_json: bool) -> None:
    if verbose >= _VERBOSE_FOR_TRACEBACK:
        traceback.print_exception(error)
    print(f"tress: {error_line(error)}", file=sys.stderr)
    if as_json:
        kind = type(error).__name__
        print(json.dumps({"ok": False, "error": error_line(error), "kind": kind, "exit_code": exit_code(error)}))
