"""The border of the compiled core: arrays of the right dtype and shape, contiguous, or a refusal."""

from typing import Any

import numpy as np

from tress.base.errors import InputError

Array = np.ndarray[Any, Any]


def checked(value: Any, *, name: str, dtype: Any, shape: tuple[int | None, ...]) -> Array:
    """`value` as a contiguous array of `dtype`; `None` in `shape` stands for any length.

    Raises `InputError`, with `name`, for another shape, ragged lists, numbers that are not finite, and whole numbers
    that `dtype` cannot hold.

    >>> checked([[1, 2, 3]], name="points", dtype=np.float64, shape=(None, 3)).dtype.name
    'float64'
    """
    given = _rectangular(value, name)
    if given.ndim != len(shape) or any(want not in (None, have) for want, have in zip(shape, given.shape, strict=True)):
        expected = ", ".join("any" if want is None else str(want) for want in shape)
        raise InputError(f"{name} has shape {given.shape}; ({expected}) was expected.")
    if given.dtype.kind not in "fiub":
        raise InputError(f"{name} has dtype {given.dtype}; numbers were expected.")
    if given.dtype.kind == "f" and not np.isfinite(given).all():
        raise InputError(f"{name} holds numbers that are not finite.")
    _refuse_lost_whole_numbers(given, name, np.dtype(dtype))
    return np.ascontiguousarray(given, dtype=dtype)


def _rectangular(value: Any, name: str) -> Array:
    try:
        return np.asarray(value)
    except ValueError as error:
        raise InputError(f"{name} is ragged; rows of equal length were expected.") from error


def _refuse_lost_whole_numbers(given: Array, name: str, dtype: np.dtype[Any]) -> None:
    if dtype.kind not in "iu" or given.size == 0 or given.dtype == dtype:
        return
    if given.dtype.kind == "f":
        raise InputError(f"{name} has dtype {given.dtype}; whole numbers were expected.")
    limits = np.iinfo(dtype)
    if given.min() < limits.min or given.max() > limits.max:
        raise InputError(f"{name} holds {given.min()} to {given.max()}; {limits.min} to {limits.max} was expected.")
