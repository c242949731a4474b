"""Attributes of Tress as primvars, and back; names that USD gives a meaning to are kept apart by a prefix."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tress.io.usd.prim import Attribute, Prim
from tress.io.usd.typing import exact_attribute, exact_values

RESERVED = ("displayColor", "displayOpacity", "st", "normals")
PREFIX = "primvars:"
OWN = "own_"


def primvars(values: Mapping[str, np.ndarray[Any, Any]], *, interpolation: str) -> dict[str, Attribute]:
    """A primvar for each attribute."""
    return {_primvar_name(name): exact_attribute(entry, interpolation=interpolation) for name, entry in values.items()}


def attributes_of(prim: Prim, *, interpolation: str) -> dict[str, np.ndarray[Any, Any]]:
    """The arrays of all primvars with that interpolation, but those that USD gives a meaning to."""
    return {
        _attribute_name(name): exact_values(entry)
        for name, entry in prim.attributes.items()
        if name.startswith(PREFIX)
        and entry.interpolation == interpolation
        and name.removeprefix(PREFIX) not in RESERVED
    }


def _primvar_name(name: str) -> str:
    return PREFIX + (OWN + name if name in RESERVED or name.startswith(OWN) else name)


def _attribute_name(primvar: str) -> str:
    return primvar.removeprefix(PREFIX).removeprefix(OWN)
