"""Strips as `UsdGeomNurbsPatch`, in the head frame, and patches of other programs as strips.

USD lists control points with u running fastest, as RenderMan does; knots are complete, as here. Blender shows no
patches and some programs would show them beside the mesh, so a patch has the purpose `guide`.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tress.base.errors import FormatError, InputError
from tress.io.usd.extent import extent
from tress.io.usd.prim import Attribute, Prim
from tress.io.usd.typing import exact_values
from tress.model.keyframes import Keyframes
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]


def patch_prim(name: str, strip: Strip, points: Array, *, samples: Mapping[float, Array]) -> Prim:
    """The patch of a strip with control `points` (U, V, 3) in the head frame, and at the times of `samples`."""
    (along, across), (degree_u, degree_v) = strip.weights.shape, strip.degrees
    boxes = {time: np.asarray(extent(_listed(found)).value) for time, found in samples.items()}
    attributes = {
        "points": Attribute(
            "point3f[]", _listed(points), samples={time: _listed(found) for time, found in samples.items()}
        ),
        "pointWeights": Attribute("double[]", _listed(strip.weights[..., None], np.float64).reshape(-1)),
        "uVertexCount": Attribute("int", along),
        "vVertexCount": Attribute("int", across),
        "uOrder": Attribute("int", degree_u + 1),
        "vOrder": Attribute("int", degree_v + 1),
        "uKnots": Attribute("double[]", strip.knots_u),
        "vKnots": Attribute("double[]", strip.knots_v),
        "uRange": Attribute("double2", strip.knots_u[[degree_u, along]]),
        "vRange": Attribute("double2", strip.knots_v[[degree_v, across]]),
        "uForm": Attribute("token", "open", uniform=True),
        "vForm": Attribute("token", "open", uniform=True),
        "purpose": Attribute("token", "guide", uniform=True),
        "doubleSided": Attribute("bool", True, uniform=True),
        "extent": replace(extent(_listed(points)), samples=boxes),
    }
    return Prim(name, "NurbsPatch", attributes)


def strip_of(prim: Prim, *, head_from_prim: Array) -> Strip:
    """The strip of a patch that any program wrote; u, the rows of the net, becomes the direction along the hair.

    Trims and parameter ranges are left out. Raises `FormatError` where the prim is no patch.
    """
    count_u, count_v = _whole(prim, "uVertexCount"), _whole(prim, "vVertexCount")
    points = prim.attributes.get("points")
    if points is None or (points.value is None and not points.samples):
        raise FormatError(f"Patch {prim.name!r} has no points.")
    first = points.value if points.value is not None else points.samples[min(points.samples)]
    weights = prim.attributes.get("pointWeights")
    found = None if weights is None else weights.value
    rows = found if isinstance(found, np.ndarray) and found.size else np.ones(count_u * count_v)
    try:
        return Strip(
            points=_net(prim, first, count_u, count_v, head_from_prim),
            weights=_rows(prim, rows, count_u, count_v)[..., 0],
            knots_u=_knots(prim, "u", count_u),
            knots_v=_knots(prim, "v", count_v),
        )
    except FormatError:
        raise
    except InputError as error:
        raise FormatError(f"Patch {prim.name!r} is no strip: {error}") from error


def keyframes_of(prim: Prim, *, target: str, head_from_prim: Array) -> Keyframes | None:
    """The motion of a patch that any program wrote: positions of its control points, or None. Raises `FormatError`."""
    samples = prim.attributes["points"].samples
    if not samples:
        return None
    counts = _whole(prim, "uVertexCount"), _whole(prim, "vVertexCount")
    times = np.array(sorted(samples))
    values = [_net(prim, samples[time], *counts, head_from_prim) for time in sorted(samples)]
    try:
        return Keyframes(target=target, times=times, values=np.stack(values), kind="position", interpolation="linear")
    except InputError as error:
        raise FormatError(f"Patch {prim.name!r} has time samples that cannot be used: {error}") from error


def _listed(values: Array, dtype: Any = np.float32) -> Array:
    """(U V, C) values with u running fastest."""
    return np.ascontiguousarray(values.transpose(1, 0, 2).reshape(-1, values.shape[2]), dtype)


def _rows(prim: Prim, values: Any, count_u: int, count_v: int) -> Array:
    """(U, V, C) values of a list with u running fastest."""
    found = np.asarray(values, np.float64)
    if min(count_u, count_v) < 1 or len(found) != count_u * count_v:
        raise FormatError(f"Patch {prim.name!r} has {len(found)} points or weights for {count_u} x {count_v}.")
    return found.reshape(count_v, count_u, -1).transpose(1, 0, 2)


def _net(prim: Prim, values: Any, count_u: int, count_v: int, head_from_prim: Array) -> Array:
    net = _rows(prim, values, count_u, count_v)
    if net.shape[2] != 3:
        raise FormatError(f"Patch {prim.name!r} has points of {net.shape[2]} numbers; 3 were expected.")
    return net @ head_from_prim[:3, :3].T + head_from_prim[:3, 3]


def _knots(prim: Prim, direction: str, count: int) -> Array:
    knots = prim.attributes.get(f"{direction}Knots")
    if knots is None:
        raise FormatError(f"Patch {prim.name!r} has no {direction}Knots.")
    values, order = exact_values(knots), _whole(prim, f"{direction}Order")
    if len(values) != count + order:
        raise FormatError(
            f"Patch {prim.name!r} has {len(values)} {direction}Knots for {count} points of order {order}; "
            f"{count + order} were expected."
        )
    return values


def _whole(prim: Prim, name: str) -> int:
    attribute = prim.attributes.get(name)
    if attribute is None or not isinstance(attribute.value, int):
        raise FormatError(f"Patch {prim.name!r} has no {name}.")
    return attribute.value
