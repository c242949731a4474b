"""Progress, timings, figures and partial failures of long work, passed in by the caller.

Libraries do not print. Whoever runs a method makes a `Report`, hands it down and reads it afterwards; a
listener gets every event while the work goes on.
"""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from tress.base.errors import CancelledError

Number = int | float | str | bool


@dataclass
class StageReport:
    """One stage of the work: its duration in seconds, its figures and what went wrong without stopping it."""

    name: str
    duration_secs: float = 0.0
    numbers: dict[str, Number] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Event:
    """What a listener receives: `kind` is "begin", "progress", "warning" or "end"."""

    kind: str
    stage: str
    fraction: float = 0.0
    message: str = ""


class Report:
    """Collects what happened, stage by stage.

    `listener` is called with every `Event`; `cancelled` is asked at every event and stops the work by `CancelledError`.

    >>> report = Report()
    >>> with report.stage("trace"):
    ...     report.number("strands", 12)
    >>> report.stages[0].numbers
    {'strands': 12}
    """

    def __init__(
        self,
        listener: Callable[[Event], None] | None = None,
        cancelled: Callable[[], bool] | None = None,
    ) -> None:
        self.stages: list[StageReport] = []
        self._open: list[StageReport] = []
        self._listener = listener
        self._cancelled = cancelled

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Times the body as the stage `name`. Stages may nest; each is listed once, in the order of its beginning."""
        stage = StageReport(name)
        self.stages.append(stage)
        self._open.append(stage)
        self._emit(Event("begin", name))
        start = time.perf_counter()
        try:
            yield
        finally:
            stage.duration_secs = time.perf_counter() - start
            self._open.pop()
        self._emit(Event("end", name, 1.0))

    def progress(self, fraction: float) -> None:
        """Says how much of the innermost stage is done, in [0, 1]."""
        self._emit(Event("progress", self._current().name, fraction))

    def number(self, name: str, value: Number) -> None:
        """Records a figure of the innermost stage."""
        self._current().numbers[name] = value

    def warn(self, message: str) -> None:
        """Records a partial failure; the work goes on."""
        self._current().warnings.append(message)
        self._emit(Event("warning", self._current().name, message=message))

    def as_dict(self) -> list[dict[str, Any]]:
        """The stages as plain dictionaries, ready for JSON."""
        return [vars(stage).copy() for stage in self.stages]

    def _current(self) -> StageReport:
        if not self._open:
            self.stages.append(StageReport("outside"))
            self._open.append(self.stages[-1])
        return self._open[-1]

    def _emit(self, event: Event) -> None:
        if self._cancelled is not None and self._cancelled():
            raise CancelledError("The work was cancelled.")
        if self._listener is not None:
            self._listener(event)
