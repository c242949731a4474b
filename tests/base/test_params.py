"""Parameters refuse what lies outside their range, with the value and the range in the message."""

from dataclasses import dataclass

import pytest

from tress.base.errors import ParameterError
from tress.base.params import Params, choice, param


@dataclass(frozen=True)
class Example(Params):
    """Two numbers and a name."""

    step_px: float = param(0.75, low=0.1, high=4.0, unit="px", doc="Length of one step.")
    count: int = param(5, low=1, high=10, doc="How many.")
    style: str = choice("photo", options=("photo", "fibre"), doc="Which style.")


def test_defaults_lie_in_range():
    assert Example() == Example(step_px=0.75, count=5, style="photo")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"step_px": 9.0}, "step_px is 9.0; a value from 0.1 to 4.0 px"),
        ({"step_px": float("nan")}, "step_px is nan"),
        ({"count": 2.5}, "count is 2.5; a whole number"),
        ({"count": True}, "count is True; a number"),
        ({"style": "toon"}, "style is 'toon'; one of photo, fibre"),
    ],
)
def test_values_outside_are_refused(arguments, message):
    with pytest.raises(ParameterError, match=message):
        Example(**arguments)
