"""A plain description of USD prims, so that mappings are pure functions that do not know `pxr`."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Value = np.ndarray[Any, Any] | int | float | str | tuple[str, ...]


@dataclass(frozen=True)
class Picture:
    """An 8-bit picture to be written beside the file: (H, W, 3 | 4) uint8, the top row first."""

    pixels: np.ndarray[Any, Any]


@dataclass(frozen=True)
class Attribute:
    """A value under its USD type name, e.g. "point3f[]", with what USD says about primvars.

    `connection` is a path below the root prim that the attribute takes its value from (shading only). `samples` holds
    values at times, in seconds.
    """

    type: str
    value: Value | Picture | None = None
    interpolation: str = ""
    element_size: int = 1
    uniform: bool = False
    connection: str = ""
    shape: tuple[int, ...] = ()
    samples: Mapping[float, Value] = field(default_factory=dict)


@dataclass(frozen=True)
class Prim:
    """A prim: its type, attributes, relationships (paths below the root prim), children and metadata of Tress."""

    name: str
    type: str
    attributes: Mapping[str, Attribute] = field(default_factory=dict)
    relationships: Mapping[str, str] = field(default_factory=dict)
    children: tuple["Prim", ...] = ()
    api_schemas: tuple[str, ...] = ()
    data: Mapping[str, Any] = field(default_factory=dict)

    def child(self, name: str) -> "Prim | None":
        """The child of that name, or None."""
        return next((prim for prim in self.children if prim.name == name), None)
