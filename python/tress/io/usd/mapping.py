"""Which record becomes which prim: a line for each that other programs should see as geometry; the rest is generic."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from tress.base.errors import FormatError
from tress.io.usd.curves import strands_of, strands_prim
from tress.io.usd.generic import record_fields, record_prim
from tress.io.usd.photo_camera import camera_of, camera_prim
from tress.io.usd.pictures import atlas_of, atlas_prim
from tress.io.usd.prim import Prim
from tress.io.usd.surface import mesh_of, mesh_prim
from tress.model.atlas import Atlas
from tress.model.camera import Camera
from tress.model.mesh import Mesh
from tress.model.record import Record
from tress.model.records import RECORDS
from tress.model.strands import Strands


@dataclass(frozen=True)
class Mapped:
    """How a record becomes a prim, and back."""

    prim: Callable[[str, Any], Prim]
    record: Callable[[Prim], Record]


MAPPINGS: Mapping[type[Record], Mapped] = {
    Strands: Mapped(strands_prim, strands_of),
    Mesh: Mapped(mesh_prim, mesh_of),
    Camera: Mapped(camera_prim, camera_of),
    Atlas: Mapped(atlas_prim, atlas_of),
}


def prim_of(name: str, record: Record) -> Prim:
    """The prim of any record."""
    mapped = MAPPINGS.get(type(record))
    return mapped.prim(name, record) if mapped else record_prim(name, record, nested=prim_of)


def record_of(prim: Prim) -> Record:
    """The record of a prim that Tress wrote. Raises `FormatError` where its type is not in `RECORDS`."""
    name = prim.data.get("record")
    kind = next((kind for kind in RECORDS if kind.__name__ == name), None)
    if kind is None:
        raise FormatError(f"Prim {prim.name!r} holds a record of type {name!r}, which this version does not know.")
    try:
        if mapped := MAPPINGS.get(kind):
            return mapped.record(prim)
        return kind(**record_fields(prim, kind, nested=record_of))
    except TypeError as error:
        raise FormatError(f"Prim {prim.name!r} does not hold all fields of a {name}.") from error
    except (ValueError, AttributeError) as error:  # NumPy's, of arrays with another shape than that of the record
        raise FormatError(f"Prim {prim.name!r} does not hold the arrays of a {name}.") from error
