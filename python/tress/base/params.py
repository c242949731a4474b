"""Parameters as frozen dataclasses whose fields know their range, unit and meaning.

Flags of the command line, tables of the documentation and the metadata in USD files are generated from them.
"""

from dataclasses import MISSING, Field, dataclass, field, fields
from typing import Any

from tress.base.errors import ParameterError


@dataclass(frozen=True)
class Range:
    """Closed range [low, high] of a parameter, its unit ("" for a pure number) and one sentence on what it does."""

    low: float
    high: float
    unit: str
    doc: str


def param(default: Any, *, low: float, high: float, unit: str = "", doc: str) -> Any:
    """A dataclass field with a default, a closed range, a unit and one sentence."""
    return field(default=default, metadata={"range": Range(low, high, unit, doc)})


def choice(default: str, *, options: tuple[str, ...], doc: str) -> Any:
    """A dataclass field with one of a few names."""
    return field(default=default, metadata={"options": options, "doc": doc})


class Params:
    """Base of the parameter dataclasses: derive, decorate with `@dataclass(frozen=True)`, declare fields by `param`.

    Raises `ParameterError` on construction where a value lies outside its range.
    """

    def __post_init__(self) -> None:
        for item in fields(self):  # type: ignore[arg-type]
            _check(item, getattr(self, item.name))


def _check(item: Field[Any], value: Any) -> None:
    limits = item.metadata.get("range")
    options = item.metadata.get("options")
    if limits is not None:
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ParameterError(f"{item.name} is {value!r}; a number was expected.")
        if not limits.low <= value <= limits.high:
            raise ParameterError(
                f"{item.name} is {value}; a value from {limits.low} to {limits.high} {limits.unit}".rstrip()
                + " was expected."
            )
        if isinstance(item.default, int) and item.default is not MISSING and not isinstance(value, int):
            raise ParameterError(f"{item.name} is {value}; a whole number was expected.")
    if options is not None and value not in options:
        raise ParameterError(f"{item.name} is {value!r}; one of {', '.join(options)} was expected.")
