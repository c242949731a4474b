"""`--set stage.name=value`: one mechanism for every parameter of every stage."""

import dataclasses
import difflib
from collections.abc import Iterator, Sequence
from typing import Any, TypeVar

from tress.base.errors import ParameterError

P = TypeVar("P")


@dataclasses.dataclass(frozen=True)
class Setting:
    """One parameter as the tables show it, named "stage.field" or "stage.group.field"; `limits` are in words."""

    name: str
    default: Any
    limits: str
    unit: str
    doc: str


def settings(params: Any) -> Iterator[Setting]:
    """Every parameter of the stages of `params`, in the order of their declaration; nested groups have longer names."""
    for group in dataclasses.fields(params):
        if dataclasses.is_dataclass(getattr(params, group.name)):
            yield from _group_settings(group.name, getattr(params, group.name))


def _group_settings(prefix: str, group: Any) -> Iterator[Setting]:
    for item in dataclasses.fields(group):
        value = getattr(group, item.name)
        if dataclasses.is_dataclass(value):
            yield from _group_settings(f"{prefix}.{item.name}", value)
        else:
            yield _setting(f"{prefix}.{item.name}", item, value)


def with_settings(params: P, assignments: Sequence[str]) -> P:
    """`params` with the `assignments` ("depth.depth_weight=2") made.

    Raises `ParameterError` for an unknown name (with the nearest known one), a value of the wrong type or one out of
    range.
    """
    known = {setting.name: setting for setting in settings(params)}
    for assignment in assignments:
        name, equals, words = assignment.partition("=")
        if not equals:
            raise ParameterError(f"--set {assignment} has no value; write it as stage.name=value.")
        if name not in known:
            raise ParameterError(f"--set {name} names no parameter;{suggestion(name, list(known))}")
        params = _assigned(params, name, _parsed(name, words, known[name].default))
    return params


def _setting(name: str, item: dataclasses.Field[Any], default: Any) -> Setting:
    limits = item.metadata.get("range")
    if limits is not None:
        return Setting(name, default, f"{limits.low:g} … {limits.high:g}", limits.unit, limits.doc)
    options = item.metadata.get("options", ("true", "false") if isinstance(default, bool) else ())
    return Setting(name, default, ", ".join(options), "", item.metadata.get("doc", ""))


def _assigned(params: P, name: str, value: Any) -> P:
    first, _, rest = name.partition(".")
    if rest:
        value = _assigned(getattr(params, first), rest, value)
    return dataclasses.replace(params, **{first: value})  # type: ignore[type-var]


def _parsed(name: str, words: str, default: Any) -> Any:
    """The words as a value of the type of the default."""
    kind = type(default)
    try:
        if kind is bool:
            return {"true": True, "false": False, "1": True, "0": False}[words.lower()]
        return kind(words) if kind in (int, float, str) else float(words)
    except (ValueError, KeyError):
        raise ParameterError(f"--set {name}={words} is no {_kind_words(kind)}.") from None


def _kind_words(kind: type) -> str:
    return {bool: "true or false", int: "whole number", str: "name"}.get(kind, "number")


def suggestion(name: str, known: list[str]) -> str:
    """What to say after an unknown name: the nearest of the `known`, if one is near, and where all are listed."""
    nearest = difflib.get_close_matches(name, known, n=1, cutoff=0.4)
    meant = f" did you mean {nearest[0]}?" if nearest else ""
    return f"{meant} `tress params` lists them all."
