"""What a person sees while a method works and when it is done; or one JSON object for programs."""

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from rich.console import Console, Group
from rich.progress import BarColumn, Progress, SpinnerColumn, TaskID, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from tress.base.report import Event, Report, StageReport

_NUMBERS_SHOWN = 4


class Delivered(Protocol):
    """What the screen can show: the folder and the files in it."""

    @property
    def folder(self) -> Path: ...
    @property
    def files(self) -> Sequence[Path]: ...


@dataclass(frozen=True)
class Screen:
    """A report that is listened to, and the console that its results go to."""

    report: Report
    console: Console
    verbose: int
    as_json: bool

    def results(self, delivered: Delivered) -> None:
        """Shows times, figures and files; as JSON where that was asked for."""
        if self.as_json:
            print(json.dumps(_as_json(self.report, delivered)))
            return
        self.console.print(_stage_table(self.report.stages, verbose=self.verbose))
        self.console.print(_file_table(delivered))


@contextmanager
def screen(*, verbose: int, quiet: bool, json_output: bool) -> Iterator[Screen]:
    """A screen whose progress bars live as long as the body; warnings go to standard error unless `quiet`."""
    errors = Console(stderr=True, quiet=quiet or json_output)
    moving = errors.is_terminal and not (quiet or json_output)
    bars = Progress(
        SpinnerColumn(),
        TextColumn("{task.description:<14}"),
        BarColumn(bar_width=30),
        TimeElapsedColumn(),
        console=errors,
        transient=True,
        disable=not moving,
    )
    with bars if moving else nullcontext():  # older Rich prints an empty line at the end of bars that it never showed
        report = Report(_Listener(bars, errors, verbose=verbose))
        yield Screen(report, Console(quiet=quiet), verbose, json_output)


class _Listener:
    """Turns events into bars, one for every stage that is not inside another; with -v also for those inside."""

    def __init__(self, bars: Progress, errors: Console, *, verbose: int) -> None:
        self._bars = bars
        self._errors = errors
        self._verbose = verbose
        self._open: list[TaskID | None] = []

    def __call__(self, event: Event) -> None:
        {"begin": self._begin, "progress": self._progress, "warning": self._warning, "end": self._end}[event.kind](
            event
        )

    def _begin(self, event: Event) -> None:
        shown = not self._open or self._verbose
        self._open.append(self._bars.add_task("  " * len(self._open) + event.stage, total=1.0) if shown else None)

    def _progress(self, event: Event) -> None:
        if self._open and self._open[-1] is not None:
            self._bars.update(self._open[-1], completed=event.fraction)

    def _warning(self, event: Event) -> None:
        self._errors.print(Text(f"tress: {event.stage}: {event.message}", style="yellow"), soft_wrap=True)

    def _end(self, _event: Event) -> None:
        task = self._open.pop()
        if task is not None:
            self._bars.update(task, completed=1.0)
            self._bars.stop_task(task)


def _stage_table(stages: Sequence[StageReport], *, verbose: int) -> Table:
    """Name, time and the first few figures of every stage; all of them with -v."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("stage")
    table.add_column("seconds", justify="right")
    table.add_column("figures")
    for stage in stages:
        shown = list(stage.numbers.items())[: None if verbose else _NUMBERS_SHOWN]
        figures = ", ".join(f"{name.replace('_', ' ')} {_figure(value)}" for name, value in shown)
        table.add_row(stage.name, f"{stage.duration_secs:.2f}", Text(figures, style="dim"))
    table.add_section()
    table.add_row("together", f"{sum(stage.duration_secs for stage in stages):.2f}", style="bold")
    return table


def _figure(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _file_table(delivered: Delivered) -> Group:
    """The files with their sizes; the stages' files in one line."""
    table = Table(box=None, pad_edge=False, show_header=False)
    table.add_column()
    table.add_column(justify="right", style="dim")
    inner = [path for path in delivered.files if path.parent != Path()]
    for path in delivered.files:
        if path not in inner:
            table.add_row(path.name, _size((delivered.folder / path).stat().st_size))
    for parent in sorted({path.parent for path in inner}):
        files = [delivered.folder / path for path in inner if path.parent == parent]
        table.add_row(f"{parent}/ ({len(files)} files)", _size(sum(file.stat().st_size for file in files)))
    older = ", ".join(path.name for path in _older_files(delivered))
    words = [Text(f"left from an earlier run: {older}", style="yellow")] if older else []
    return Group(Text(f"\nwritten to {delivered.folder}/", style="bold"), table, *words)


def _older_files(delivered: Delivered) -> list[Path]:
    """Files of the results' names in the folder that this run did not write."""
    names = {path.name for path in delivered.files}
    found = [*delivered.folder.glob("hair.*"), delivered.folder / "turntable.webm"]
    return sorted(path for path in found if path.is_file() and path.name not in names)


def _size(byte_count: int) -> str:
    return f"{byte_count / 1e6:.1f} MB" if byte_count >= 1e5 else f"{byte_count / 1e3:.1f} kB"


def _as_json(report: Report, delivered: Delivered) -> dict[str, Any]:
    files = {str(path): (delivered.folder / path).stat().st_size for path in delivered.files}
    return {"ok": True, "folder": str(delivered.folder), "files": files, "stages": report.as_dict()}
