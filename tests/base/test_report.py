"""A report lists its stages in order, keeps figures apart and stops on request."""

import pytest

from tress.base.errors import CancelledError
from tress.base.report import Event, Report


def test_nested_stages_are_listed_in_order_of_beginning():
    report = Report()
    with report.stage("outer"):
        with report.stage("inner"):
            report.number("n", 1)
        report.number("m", 2)
    assert [(stage.name, stage.numbers) for stage in report.stages] == [("outer", {"m": 2}), ("inner", {"n": 1})]


def test_listener_hears_every_event():
    events: list[Event] = []
    report = Report(events.append)
    with report.stage("trace"):
        report.progress(0.5)
        report.warn("twelve strands were not traced")
    assert [event.kind for event in events] == ["begin", "progress", "warning", "end"]


def test_cancel_stops_the_work():
    report = Report(cancelled=lambda: True)
    with pytest.raises(CancelledError), report.stage("trace"):
        raise AssertionError("the body must not run")
