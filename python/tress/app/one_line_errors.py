"""Wrong words on the command line, told like every other error: in one line."""

import sys
from typing import Any

import typer
from typer.core import TyperGroup

from tress.app.exit_codes import BAD_INPUT, INTERRUPTED


class OneLineErrors(TyperGroup):
    """The commands of `tress`; what they cannot parse is told as `tress: …` on standard error, with exit code 2."""

    def main(self, *arguments: Any, standalone_mode: bool = True, **options: Any) -> Any:
        """Parses and runs. Raises `SystemExit` unless `standalone_mode` says otherwise."""
        if not standalone_mode:
            return super().main(*arguments, standalone_mode=False, **options)
        try:
            code = super().main(*arguments, standalone_mode=False, **options)
        except typer.Abort:
            sys.exit(INTERRUPTED)
        except Exception as error:
            if not hasattr(error, "format_message"):  # what the parser raises has it; its class moved between versions
                raise
            sys.exit(_told(error))
        sys.exit(code if isinstance(code, int) else 0)


def _told(error: Any) -> int:
    if type(error).__name__ == "NoArgsIsHelpError":
        print(error.ctx.get_help())
    else:
        print(f"tress: {' '.join(error.format_message().split())}", file=sys.stderr)
    return getattr(error, "exit_code", BAD_INPUT)
