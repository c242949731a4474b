"""What all records share: declared arrays, checked and frozen on construction, and equality bit by bit.

A record is a frozen dataclass that derives from `Record`. Each field is declared by one of `array`, `attributes`,
`names`, or is a plain `int`, `float`, `str`, or another record. The declarations are data: the checks, the lossless
USD mapping and generated schemas read them, so that a new record type is one file and one line in `RECORDS`.
"""

from collections.abc import Mapping
from dataclasses import Field, dataclass, field, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from tress.base.errors import InputError
from tress.model.frozen_map import FrozenMap

if TYPE_CHECKING:
    from tress.model.document import Document
    from tress.model.mesh import Mesh
    from tress.model.strands import Strands

ATTRIBUTE_DTYPES = tuple(np.dtype(name) for name in ("f4", "f8", "i4", "i8", "u1", "?"))
Scalar = bool | int | float | str


@dataclass(frozen=True)
class ArraySpec:
    """An array: its dtype, its shape (numbers, or letters that agree within the record), whether it may be None."""

    dtype: np.dtype[Any]
    shape: tuple[int | str, ...]
    optional: bool
    doc: str


@dataclass(frozen=True)
class AttributesSpec:
    """Named arrays whose first length is the letter `leading`; those in `standard` have a fixed dtype and shape."""

    leading: str
    standard: Mapping[str, tuple[str, tuple[int, ...]]]
    doc: str


def array(dtype: str, *shape: int | str, optional: bool = False, doc: str) -> Any:
    """A field that holds an array, e.g. `array("f4", "N", 3, doc="…")`; `optional` makes None its default."""
    spec = ArraySpec(np.dtype(dtype), shape, optional, doc)
    return field(default=None, metadata={"array": spec}) if optional else field(metadata={"array": spec})


def attributes(leading: str, *, standard: Mapping[str, tuple[str, tuple[int, ...]]] | None = None, doc: str) -> Any:
    """A field that holds named arrays, one row per `leading`; empty by default."""
    spec = AttributesSpec(leading, standard or {}, doc)
    return field(default_factory=FrozenMap, metadata={"attributes": spec})


def names(doc: str) -> Any:
    """A field that holds names with a number, truth value or text each; empty by default."""
    return field(default_factory=FrozenMap, metadata={"names": doc})


@dataclass(frozen=True, eq=False)
class Record:
    """Base of the records: derive, decorate with `@dataclass(frozen=True, eq=False)`, declare fields.

    Arrays are converted to the declared dtype where that loses no kind (integers may become floats, not the reverse),
    are contiguous and read-only, and hold finite numbers, negative zero
    as zero. Two records are equal if their types and all bits agree.
    Raises `InputError` on construction where a field does not fit its declaration.
    """

    __hash__ = None  # type: ignore[assignment]

    def __post_init__(self) -> None:
        sizes: dict[str, int] = {}
        for item in fields(self):
            object.__setattr__(self, item.name, _checked(self, item, sizes))
        self.check()

    def check(self) -> None:
        """Raises `InputError` where fields contradict each other. For records to override."""

    def check_in(self, document: "Document", *, name: str) -> None:
        """Raises `InputError` where a record that this one names is absent or of another kind. For records to override.

        `name` is the identifier of this record.
        """

    def evaluated(self, document: "Document", time: float, *, name: str) -> "Strands | Mesh | None":
        """What there is to see of this record, `name`, at `time` (seconds), or None. For records to override."""
        return None

    def transformed(self, new_from_old: np.ndarray[Any, Any]) -> "Record":
        """The record after a rotation, shift and even scaling (4, 4). For records that have a place to override.

        Raises `InputError` where the record has no place, or the matrix does anything else.
        """
        raise InputError(f"A {type(self).__name__} has no place in space and cannot be transformed.")

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return all(same(getattr(self, item.name), getattr(other, item.name)) for item in fields(self))


def same(a: object, b: object) -> bool:
    """Whether two field values agree in type, dtype, shape and every bit."""
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return list(a) == list(b) and all(same(a[name], b[name]) for name in a)
    return type(a) is type(b) and a == b


def frozen(values: Any) -> np.ndarray[Any, Any]:
    """A contiguous read-only array; copied unless it already is one."""
    result = np.ascontiguousarray(values).reshape(np.shape(values))
    if result.flags.writeable:
        result = result.copy() if np.may_share_memory(result, values) else result
        result.flags.writeable = False
    return result


def _checked(record: Record, item: Field[Any], sizes: dict[str, int]) -> Any:
    value = getattr(record, item.name)
    where = f"{type(record).__name__}.{item.name}"
    if spec := item.metadata.get("array"):
        return None if value is None and spec.optional else _checked_array(where, value, spec, sizes)
    if spec := item.metadata.get("attributes"):
        return _checked_attributes(where, value, spec, sizes)
    if "names" in item.metadata:
        return _checked_names(where, value)
    return _checked_plain(where, value, item.type)


def _checked_array(where: str, value: Any, spec: ArraySpec, sizes: dict[str, int]) -> np.ndarray[Any, Any]:
    result = _converted(where, value, spec.dtype)
    wanted = tuple(_known(size, sizes) for size in spec.shape)
    fits = len(wanted) == result.ndim and all(
        isinstance(want, str) or want == have for want, have in zip(wanted, result.shape, strict=True)
    )
    if not fits:
        raise InputError(f"{where} has shape {result.shape}; ({', '.join(map(str, wanted))}) was expected.")
    sizes.update(_letters(wanted, result.shape))
    return result


def _known(size: int | str, sizes: Mapping[str, int]) -> int | str:
    return sizes.get(size, size) if isinstance(size, str) else size


def _letters(wanted: tuple[int | str, ...], found: tuple[int, ...]) -> dict[str, int]:
    """What the letters in a declared shape stand for; "S+1" rows bind S."""
    pairs = [(want, have) for want, have in zip(wanted, found, strict=True) if isinstance(want, str)]
    return {want.removesuffix("+1"): have - want.endswith("+1") for want, have in pairs}


def _checked_attributes(where: str, value: Any, spec: AttributesSpec, sizes: dict[str, int]) -> FrozenMap[Any]:
    count = sizes[spec.leading]
    result = {}
    for name, values in value.items():
        place = f'{where}["{name}"]'
        _check_name(place, name)
        if name in spec.standard:
            dtype, shape = spec.standard[name]
            result[name] = _checked_array(place, values, ArraySpec(np.dtype(dtype), (count, *shape), False, ""), sizes)
            continue
        found = np.asarray(values)
        if found.dtype not in ATTRIBUTE_DTYPES:
            raise InputError(f"{place} has dtype {found.dtype}; one of {_listed(ATTRIBUTE_DTYPES)} was expected.")
        result[name] = _converted(place, found, found.dtype)
        if found.shape[:1] != (count,):
            raise InputError(f"{place} has shape {found.shape}; {count} rows were expected.")
        if 0 in found.shape[1:]:
            raise InputError(f"{place} has shape {found.shape}; rows with at least one number were expected.")
    return FrozenMap(result)


def _checked_names(where: str, value: Any) -> FrozenMap[Scalar]:
    for name, entry in value.items():
        if not isinstance(name, str) or not name or type(entry) not in (bool, int, float, str):
            raise InputError(f"{where}[{name!r}] is {entry!r}; a number, truth value or text was expected.")
        _check_storable(where, name)
        _check_storable(f"{where}[{name!r}]", entry)
    return FrozenMap({name: entry + 0.0 if isinstance(entry, float) else entry for name, entry in value.items()})


def _checked_plain(where: str, value: Any, kind: Any) -> Any:
    if kind is int and isinstance(value, np.integer):
        return int(value)
    if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
        raise InputError(f"{where} is {value!r}; {getattr(kind, '__name__', kind)} was expected.")
    _check_storable(where, value)
    return value + 0.0 if isinstance(value, float) else value


def _check_storable(where: str, value: Any) -> None:
    """Refuses what files cannot hold: not a number, integers beyond 64 bits, text that is no Unicode or holds NUL."""
    if isinstance(value, int) and not -(2**63) <= value < 2**63:
        raise InputError(f"{where} is {value}; a whole number of 64 bits was expected.")
    if isinstance(value, float) and value != value:
        raise InputError(f"{where} is not a number.")
    if isinstance(value, str) and ("\0" in value or (not value.isprintable() and _is_broken(value))):
        raise InputError(f"{where} is {value!r}; Unicode text without NUL was expected.")


def _is_broken(text: str) -> bool:
    return any("\ud800" <= letter <= "\udfff" for letter in text)


def _converted(where: str, value: Any, dtype: np.dtype[Any]) -> np.ndarray[Any, Any]:
    try:
        found = np.asarray(value)
    except ValueError as error:
        raise InputError(f"{where} is not a rectangular array ({error}).") from error
    if found.dtype != dtype:
        if found.size and not np.can_cast(found.dtype, dtype, casting="same_kind"):
            raise InputError(f"{where} has dtype {found.dtype}; {dtype} was expected.")
        with np.errstate(over="ignore"):
            found = found.astype(dtype)
    if dtype.kind == "f" and not np.isfinite(found).all():
        raise InputError(f"{where} holds numbers that are not finite.")
    return frozen(_without_negative_zero(found))


def _without_negative_zero(values: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """USD keeps one of two equal arrays, and 0 equals -0: with one zero, equal is the same bits."""
    if values.dtype.kind != "f" or not np.any((values == 0) & np.signbit(values)):
        return values
    return values + values.dtype.type(0)


def _check_name(where: str, name: object) -> None:
    if not isinstance(name, str) or not name.isidentifier() or not name.isascii():
        raise InputError(f"{where}: a name of letters, digits and underscores was expected.")


def _listed(dtypes: tuple[np.dtype[Any], ...]) -> str:
    return ", ".join(str(dtype) for dtype in dtypes)
