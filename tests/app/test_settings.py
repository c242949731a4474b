"""`--set stage.name=value` reaches every parameter, and says what is wrong in one sentence."""

from dataclasses import dataclass, field

import pytest

from tress.app.settings import settings, with_settings
from tress.base.errors import ParameterError
from tress.base.params import Params, choice, param


@dataclass(frozen=True)
class EndParams(Params):
    """A group within a stage."""

    taper: float = param(0.5, low=0.0, high=1.0, doc="How much strands taper.")


@dataclass(frozen=True)
class TraceParams(Params):
    """One of every kind."""

    step_px: float = param(0.75, low=0.1, high=4.0, unit="px", doc="Length of one step.")
    health: int = param(5, low=1, high=100, doc="Steps without certainty.")
    style: str = choice("photo", options=("photo", "fibre"), doc="Which style.")
    both_ways: bool = True
    ends: EndParams = field(default_factory=EndParams)


@dataclass(frozen=True)
class MethodParams:
    """A seed and a stage."""

    seed: int = 0
    trace: TraceParams = field(default_factory=TraceParams)


def test_assignments_keep_the_type_of_the_default():
    assignments = ["trace.step_px=2", "trace.health=7", "trace.style=fibre", "trace.both_ways=false"]
    changed = with_settings(MethodParams(seed=3), assignments)
    assert changed == MethodParams(3, TraceParams(step_px=2.0, health=7, style="fibre", both_ways=False))
    assert isinstance(changed.trace.step_px, float)


def test_groups_within_a_stage_have_longer_names():
    assert with_settings(MethodParams(), ["trace.ends.taper=1"]).trace.ends == EndParams(taper=1.0)


@pytest.mark.parametrize(
    ("assignment", "message"),
    [
        ("trace.health", "has no value"),
        ("trace.helth=3", r"did you mean trace\.health\?"),
        ("seed=3", "names no parameter"),
        ("trace.health=2.5", "no whole number"),
        ("trace.step_px=wide", "no number"),
        ("trace.step_px=9", r"from 0\.1 to 4\.0 px"),
        ("trace.step_px=nan", "step_px is nan"),
        ("trace.style=toon", "one of photo, fibre"),
        ("trace.both_ways=maybe", "no true or false"),
    ],
)
def test_mistakes_are_named(assignment, message):
    with pytest.raises(ParameterError, match=message):
        with_settings(MethodParams(), [assignment])


def test_tables_show_ranges_units_and_choices():
    rows = {row.name: row for row in settings(MethodParams())}
    assert list(rows) == ["trace.step_px", "trace.health", "trace.style", "trace.both_ways", "trace.ends.taper"]
    assert (rows["trace.step_px"].limits, rows["trace.step_px"].unit) == ("0.1 … 4", "px")
    assert rows["trace.style"].limits == "photo, fibre"
