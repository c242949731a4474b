"""Any record as a prim, without loss: what a record type gets that has no mapping of its own.

Fields become attributes in the namespace `tress`, records within a record become children, and numbers and texts by
name become metadata. Other programs see no geometry in it; that is what a mapping of its own is for.
"""

from collections.abc import Callable
from dataclasses import fields
from typing import Any

from tress.io.usd.prim import Attribute, Prim
from tress.io.usd.typing import exact_attribute, exact_values
from tress.model.record import Record

PLAIN = {int: "int64", float: "double", str: "string", bool: "bool"}
ToPrim = Callable[[str, Record], Prim]
FromPrim = Callable[[Prim], Record]


def record_prim(name: str, record: Record, *, nested: ToPrim, only: tuple[str, ...] | None = None) -> Prim:
    """The prim of a record; `nested` maps records within it, `only` restricts the fields that are written."""
    attributes: dict[str, Attribute] = {}
    children: list[Prim] = []
    data: dict[str, Any] = {"record": type(record).__name__}
    for item in fields(record):
        value = getattr(record, item.name)
        if value is None or (only is not None and item.name not in only):
            continue
        if isinstance(value, Record):
            children.append(nested(item.name, value))
        elif "names" in item.metadata:
            data[item.name] = dict(value)
        elif "attributes" in item.metadata:
            attributes |= {f"tress:{item.name}:{key}": exact_attribute(entry) for key, entry in value.items()}
        elif "array" in item.metadata:
            attributes[f"tress:{item.name}"] = exact_attribute(value)
        else:
            attributes[f"tress:{item.name}"] = Attribute(PLAIN[type(value)], value)
    return Prim(name, "Xform", attributes, children=tuple(children), data=data)


def record_fields(prim: Prim, kind: type[Record], *, nested: FromPrim) -> dict[str, Any]:
    """The fields of a record of type `kind`, as far as the prim holds them."""
    result: dict[str, Any] = {}
    for item in fields(kind):
        name = f"tress:{item.name}"
        if "names" in item.metadata:
            result[item.name] = dict(prim.data.get(item.name, {}))
        elif "attributes" in item.metadata:
            found = {key: entry for key, entry in prim.attributes.items() if key.startswith(name + ":")}
            result[item.name] = {key.removeprefix(name + ":"): exact_values(entry) for key, entry in found.items()}
        elif name in prim.attributes:
            entry = prim.attributes[name]
            result[item.name] = exact_values(entry) if "array" in item.metadata else entry.value
        elif (child := prim.child(item.name)) is not None:
            result[item.name] = nested(child)
    return result
