"""How a document came about, so that the method can be run again."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

from tress.base.errors import InputError
from tress.base.params import Params
from tress.model.record import Record, Scalar, names


@dataclass(frozen=True, eq=False)
class Recipe(Record):
    """A method's name, its seed, its parameters by dotted name, and its input files by name with their SHA-256."""

    method: str
    seed: int = 0
    parameters: Mapping[str, Scalar] = names("Parameters by dotted name, e.g. `trace.step_px`.")
    inputs: Mapping[str, Scalar] = names("Input files and their SHA-256.")

    def check(self) -> None:
        """The method has a name."""
        if not self.method:
            raise InputError("Recipe.method is empty; a name was expected.")


def flat_parameters(params: Params, *, prefix: str = "") -> dict[str, Scalar]:
    """Parameters by dotted name; parameters within parameters are joined by a dot, and None is left out."""
    result: dict[str, Scalar] = {}
    for item in fields(params):  # type: ignore[arg-type]
        value: Any = getattr(params, item.name)
        if is_dataclass(value):
            result |= flat_parameters(value, prefix=f"{prefix}{item.name}.")  # type: ignore[arg-type]
        elif value is not None:
            result[prefix + item.name] = value
    return result
