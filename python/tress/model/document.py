"""What hair is, apart from how it was made or is shown: named records."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from tress.base.errors import InputError
from tress.model.frozen_map import FrozenMap
from tress.model.record import Record

Kind = TypeVar("Kind", bound=Record)


@dataclass(frozen=True)
class Document:
    """An immutable mapping from identifier to record; all in the head frame, metres.

    Identifiers are ASCII letters, digits and underscores, not beginning with a digit. A portrait holds `head` (`Head`),
    `hair` (`Strands`), `photo` (`Camera`) and `recipe` (`Recipe`). A document changes by `diff.apply` alone.
    Raises `InputError` for other identifiers and values, and where a record names another that is not there.
    """

    records: Mapping[str, Record] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for identifier, record in self.records.items():
            if not isinstance(identifier, str) or not identifier.isidentifier() or not identifier.isascii():
                raise InputError(f"Record identifier {identifier!r}: letters, digits and underscores were expected.")
            if not isinstance(record, Record):
                raise InputError(f"Record {identifier!r} is a {type(record).__name__}; a record was expected.")
        object.__setattr__(self, "records", FrozenMap(self.records))
        for identifier, record in self.records.items():
            record.check_in(self, name=identifier)

    __hash__ = None  # type: ignore[assignment]

    def of_type(self, kind: type[Kind]) -> dict[str, Kind]:
        """The records of one type by identifier."""
        return {name: record for name, record in self.records.items() if isinstance(record, kind)}
