"""An atlas as a prim whose pictures lie beside the file as PNG, which loses nothing."""

from dataclasses import replace

import numpy as np

from tress.base.errors import FormatError
from tress.io.usd.generic import record_fields, record_prim
from tress.io.usd.prim import Attribute, Picture, Prim
from tress.model.atlas import Atlas
from tress.model.record import Record

PREFIX = "tress:picture:"


def atlas_prim(name: str, atlas: Atlas) -> Prim:
    """The prim of an atlas; maps of three or four bytes a pixel are pictures too, the others arrays."""
    maps = {key: values for key, values in atlas.maps.items() if _is_picture(values)}
    others = replace(atlas, maps={key: values for key, values in atlas.maps.items() if key not in maps})
    plain = record_prim(name, others, nested=_no_prim, only=("regions", "maps"))
    pictures = {"color": atlas.color} | {f"map_{key}": values for key, values in maps.items()}
    assets = {PREFIX + key: Attribute("asset", Picture(values)) for key, values in pictures.items()}
    return replace(plain, attributes={**plain.attributes, **assets})


def atlas_of(prim: Prim) -> Atlas:
    """The atlas of a prim. Raises `FormatError` where a picture is missing."""
    fields = record_fields(prim, Atlas, nested=_no_record)
    pictures = {
        name.removeprefix(PREFIX): entry.value.pixels
        for name, entry in prim.attributes.items()
        if name.startswith(PREFIX) and isinstance(entry.value, Picture)
    }
    if "color" not in pictures:
        raise FormatError(f"Atlas {prim.name!r} has no picture.")
    fields["color"] = pictures.pop("color")
    fields["maps"] |= {name.removeprefix("map_"): pixels for name, pixels in pictures.items()}
    return Atlas(**fields)


def _is_picture(values: np.ndarray) -> bool:
    return values.dtype == np.uint8 and values.ndim == 3 and values.shape[2] in (3, 4)


def _no_prim(name: str, record: Record) -> Prim:
    raise TypeError(f"an atlas holds no {type(record).__name__} {name!r}")


def _no_record(prim: Prim) -> Record:
    raise TypeError(f"an atlas holds no {prim.type}")
