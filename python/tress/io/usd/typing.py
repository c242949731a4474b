"""Which USD type holds which array, exactly."""

from typing import Any

import numpy as np

from tress.base.errors import FormatError
from tress.io.usd.prim import Attribute

Array = np.ndarray[Any, Any]

SCALARS = {"f4": "float", "f8": "double", "i4": "int", "i8": "int64", "u1": "uchar", "?": "bool"}
VECTORS = ("f4", "f8", "i4")
DTYPES = {name: np.dtype(code) for code, name in SCALARS.items()}


def exact_attribute(values: Array, *, interpolation: str = "") -> Attribute:
    """An attribute that holds (N, …) values bit by bit: a vector type where USD has one, else `elementSize`."""
    code = values.dtype.kind if values.dtype.kind == "b" else values.dtype.str[1:]
    name = SCALARS["?" if code == "b" else code]
    shape = values.shape[1:]
    if len(shape) == 1 and shape[0] in (2, 3, 4) and code in VECTORS:
        return Attribute(f"{name}{shape[0]}[]", values, interpolation)
    size = int(np.prod(shape)) if shape else 1
    return Attribute(f"{name}[]", values.reshape(-1), interpolation, element_size=size, shape=shape)


def exact_values(attribute: Attribute) -> Array:
    """The array of an attribute made by `exact_attribute`. Raises `FormatError` where there is none of that shape."""
    values = attribute.value
    if not isinstance(values, np.ndarray):
        raise FormatError(f"An attribute of type {attribute.type} holds {values!r}; an array was expected.")
    if not attribute.shape:
        return values
    try:
        return values.reshape(-1, *attribute.shape)
    except ValueError as error:
        raise FormatError(f"{values.size} numbers cannot be rows of shape {attribute.shape}.") from error
