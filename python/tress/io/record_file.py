"""Frozen dataclasses of arrays in one .npz file, and back, bit for bit.

The arrays lie in the archive under the path of their field (`layers/label`); one JSON entry holds the tree: which
class, which fields, which plain values. Nothing is pickled, and only dataclasses of Tress are made on reading, so a
foreign file can do no harm.
"""

import dataclasses
import importlib
import io
import json
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from tress.base.errors import FormatError
from tress.io.archive import DAMAGE, check_size

_TREE = "__tree__"
_PLAIN = (str, int, float, bool, type(None))
_SAMPLE_BYTES = 16384
_WORTHWHILE = 0.7
"""Compressed arrays are at most this part as long."""


def save_record(path: Path, record: Any, *, header: Mapping[str, str] | None = None) -> None:
    """Writes the dataclass `record` and the words of `header` into the .npz file `path`.

    A field may hold an array, a plain value, another dataclass of Tress, a tuple or list, or a mapping with names as
    keys. Raises `TypeError` on anything else: that is a mistake of the programmer.
    """
    arrays: dict[str, np.ndarray] = {}
    tree = _tree(record, "record", arrays)
    words = json.dumps({"header": dict(header or {}), "tree": tree})
    with zipfile.ZipFile(path, "w") as archive:
        for entry, values in {_TREE: np.array(words), **arrays}.items():
            file = io.BytesIO()
            np.lib.format.write_array(file, np.asanyarray(values), allow_pickle=False)
            method = zipfile.ZIP_DEFLATED if _is_compressible(file.getbuffer()) else zipfile.ZIP_STORED
            archive.writestr(zipfile.ZipInfo(f"{entry}.npy"), file.getbuffer(), method, compresslevel=1)


def _is_compressible(data: memoryview) -> bool:
    """Whether compression is worth its time, told from three samples: maps that are mostly empty, not coordinates."""
    places = [len(data) * part // 4 for part in (1, 2, 3)]
    sample = b"".join(data[place : place + _SAMPLE_BYTES] for place in places)
    return len(zlib.compress(sample, 1)) < _WORTHWHILE * len(sample)


def load_record(path: Path) -> tuple[Any, dict[str, str]]:
    """The record in `path` and its header. Raises `FormatError` where the file is not one of `save_record`."""
    try:
        check_size(path)
        with np.load(path, allow_pickle=False) as archive:
            words = json.loads(str(archive[_TREE]))
            return _value(words["tree"], archive), words["header"]
    except DAMAGE as error:
        raise FormatError(f"{path} does not hold the result of a stage ({error}); run the stage again.") from error


def load_header(path: Path) -> dict[str, str]:
    """The header alone; cheap. Raises `FormatError` like `load_record`."""
    try:
        with np.load(path, allow_pickle=False) as archive:
            return json.loads(str(archive[_TREE]))["header"]
    except DAMAGE as error:
        raise FormatError(f"{path} does not hold the result of a stage ({error}); run the stage again.") from error


def _tree(value: Any, name: str, arrays: dict[str, np.ndarray]) -> Any:
    """The value as JSON; arrays go into `arrays` under their path."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, np.ndarray):
        arrays[name] = value
        return {"array": name}
    if isinstance(value, _PLAIN):
        return {"plain": value}
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {"class": _class_name(type(value)), "fields": _fields(value, name, arrays)}
    if isinstance(value, Mapping):
        return {"mapping": {key: _tree(item, f"{name}/{key}", arrays) for key, item in value.items()}}
    if isinstance(value, tuple | list):
        kind = "tuple" if isinstance(value, tuple) else "list"
        return {kind: [_tree(item, f"{name}/{index}", arrays) for index, item in enumerate(value)]}
    raise TypeError(f"{name} is a {type(value).__name__}, which cannot be stored")


def _fields(record: Any, name: str, arrays: dict[str, np.ndarray]) -> dict[str, Any]:
    fields = [field for field in dataclasses.fields(record) if field.init]
    return {field.name: _tree(getattr(record, field.name), f"{name}/{field.name}", arrays) for field in fields}


def _value(tree: Any, archive: Mapping[str, np.ndarray]) -> Any:
    """The value that `_tree` described."""
    ((kind, content),) = ((key, item) for key, item in tree.items() if key != "fields")
    if kind == "array":
        return archive[content]
    if kind == "plain":
        return content
    if kind == "class":
        return _class(content)(**{name: _value(item, archive) for name, item in tree["fields"].items()})
    if kind == "mapping":
        return {key: _value(item, archive) for key, item in content.items()}
    return {"tuple": tuple, "list": list}[kind](_value(item, archive) for item in content)


def _class_name(kind: type) -> str:
    if not kind.__module__.startswith("tress."):
        raise TypeError(f"{kind.__qualname__} is not a record of Tress")
    return f"{kind.__module__}:{kind.__qualname__}"


def _class(name: str) -> type:
    module, _, qualname = name.partition(":")
    if not module.startswith("tress."):
        raise ValueError(f"{name} is not a record of Tress")
    kind = getattr(importlib.import_module(module), qualname)
    if not dataclasses.is_dataclass(kind) or not isinstance(kind, type):
        raise ValueError(f"{name} is not a record of Tress")
    return kind
