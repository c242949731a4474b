"""Strands as `UsdGeomBasisCurves`.

The basis is `linear`: it is the one that Blender, Unreal and renderers all read exactly. Widths are diameters; colour
and opacity are the standard primvars, linear light; the other attributes are primvars under their own names.
"""

import numpy as np

from tress.base.errors import FormatError
from tress.io.usd.extent import extent
from tress.io.usd.prim import Attribute, Prim
from tress.io.usd.primvars import attributes_of, primvars
from tress.io.usd.typing import exact_values
from tress.model.strands import Strands

UNREAL = "GroomAPI"  # the schema by which Unreal recognises hair


def strands_prim(name: str, strands: Strands) -> Prim:
    """The prim of strands."""
    point = dict(strands.point_attributes)
    color, alpha, radius = (point.pop(standard, None) for standard in ("color", "alpha", "radius"))
    attributes = {
        "points": Attribute("point3f[]", strands.points),
        "curveVertexCounts": Attribute("int[]", strands.lengths.astype(np.int32)),
        "type": Attribute("token", "linear", uniform=True),
        "wrap": Attribute("token", "nonperiodic", uniform=True),
        "extent": extent(strands.points, margin=0.0 if radius is None or not radius.size else float(radius.max())),
    }
    if radius is not None:
        attributes["widths"] = Attribute("float[]", radius * np.float32(2), "vertex")
    if color is not None:
        attributes["primvars:displayColor"] = Attribute("color3f[]", color, "vertex")
    if alpha is not None:
        attributes["primvars:displayOpacity"] = Attribute("float[]", alpha, "vertex")
    attributes |= primvars(point, interpolation="vertex")
    attributes |= primvars(strands.strand_attributes, interpolation="uniform")
    return Prim(name, "BasisCurves", attributes, api_schemas=(UNREAL,), data={"record": "Strands"})


def strands_of(prim: Prim) -> Strands:
    """The strands of a prim. Raises `FormatError` where it holds other curves than linear ones."""
    if prim.attributes.get("type", Attribute("token", "cubic")).value != "linear":
        raise FormatError(f"Curves {prim.name!r} are not linear; linear curves were expected.")
    points, counts = (prim.attributes.get(name) for name in ("points", "curveVertexCounts"))
    if points is None or counts is None:
        raise FormatError(f"Curves {prim.name!r} have no points or no vertex counts.")
    lengths = exact_values(counts)
    if lengths.dtype != np.int32:
        raise FormatError(f"Curves {prim.name!r} have counts of type {lengths.dtype}; whole numbers were expected.")
    point_attributes = attributes_of(prim, interpolation="vertex")
    for name, standard in (("primvars:displayColor", "color"), ("primvars:displayOpacity", "alpha")):
        if name in prim.attributes:
            point_attributes[standard] = exact_values(prim.attributes[name])
    if "widths" in prim.attributes:
        with np.errstate(invalid="ignore"):  # what is not a number is refused with the strands
            point_attributes["radius"] = exact_values(prim.attributes["widths"]) / np.float32(2)
    return Strands(
        points=exact_values(points),
        offsets=np.concatenate([[0], np.cumsum(lengths, dtype=np.int64)]),
        point_attributes=point_attributes,
        strand_attributes=attributes_of(prim, interpolation="uniform"),
    )
