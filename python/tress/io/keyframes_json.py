"""Keyframes as JSON, for people and programs that make motion elsewhere."""

import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np

from tress.base.errors import FormatError, InputError
from tress.model.keyframes import Keyframes

_FIELDS = {item.name for item in dataclasses.fields(Keyframes)}


def read_keyframes_json(path: Path) -> list[Keyframes]:
    """The keyframes in a file: one object, or a list, whose fields are those of `Keyframes`.

    `values` are nested lists (moment, row, column, xyz), metres; (moment, xyz) moves all points alike.
    Raises `InputError` where there is no file, `FormatError` where it is not such JSON.
    """
    if not path.is_file():
        raise InputError(f"{path} does not exist; name a file of keyframes in JSON.")
    try:
        content = json.loads(path.read_text())
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
        raise FormatError(f"{path} is not JSON: {error}.") from error
    entries = content if isinstance(content, list) else [content]
    return [_keyframes(path, number, entry) for number, entry in enumerate(entries)]


def _keyframes(path: Path, number: int, entry: Any) -> Keyframes:
    if not isinstance(entry, dict) or not {"target", "times", "values"} <= set(entry):
        raise FormatError(f"{path}: entry {number} is no object with target, times and values.")
    unknown = sorted(set(entry) - _FIELDS)
    if unknown:
        raise FormatError(f"{path}: entry {number} has {', '.join(unknown)}; known are {', '.join(sorted(_FIELDS))}.")
    fields = dict(entry)
    try:
        for name in ("values", "tangents"):
            if fields.get(name) is not None:
                found = np.array(fields[name], np.float64)
                fields[name] = found[:, None, None, :] if found.ndim == 2 else found
        return Keyframes(**fields)
    except (InputError, ValueError, TypeError) as error:
        raise FormatError(f"{path}: entry {number} cannot be used: {error}") from error
