"""What USD's validators do not see in curves: our own checks of a document's prims.

They miss a wrong sum of vertex counts, primvars of the wrong length and a missing extent.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from tress.io.usd.prim import Attribute, Prim
from tress.io.usd.stage import read_stage, validation_errors


def document_errors(path: Path) -> list[str]:
    """Everything that USD's validators and ours say against a file that Tress wrote: empty if nothing."""
    prims, _ = read_stage(path)
    return validation_errors(path) + [error for prim in prims for error in curve_errors(prim)]


def curve_errors(prim: Prim) -> list[str]:
    """What is wrong with the curves of a prim and of those within it."""
    own = list(_curve_errors(prim)) if prim.type == "BasisCurves" else []
    return [f"{prim.name}: {error}" for error in own] + [
        error for child in prim.children for error in curve_errors(child)
    ]


def _curve_errors(prim: Prim) -> Iterator[str]:
    points, counts = _rows(prim, "points"), _rows(prim, "curveVertexCounts")
    if points is None or counts is None:
        yield "points or curveVertexCounts are missing"
        return
    if counts.sum() != len(points):
        yield f"curveVertexCounts add up to {counts.sum()}, but there are {len(points)} points"
    if counts.size and counts.min() < 2:
        yield f"a curve has {counts.min()} vertices; linear curves have at least 2"
    if [_token(prim, name) for name in ("type", "wrap")] != ["linear", "nonperiodic"]:
        yield "the curves are not linear and nonperiodic"
    sizes = {"constant": 1, "uniform": len(counts), "varying": len(points), "vertex": len(points)}
    for name, attribute in prim.attributes.items():
        if attribute.interpolation:
            yield from _length_errors(name, attribute, sizes)
    yield from _extent_errors(prim, points)


def _length_errors(name: str, attribute: Attribute, sizes: dict[str, int]) -> Iterator[str]:
    wanted = sizes.get(attribute.interpolation)
    found = len(attribute.value) if isinstance(attribute.value, np.ndarray) else 0
    if wanted is None:
        yield f"{name} has interpolation {attribute.interpolation}"
    elif found != wanted * int(np.prod(attribute.shape or (1,))):
        yield f"{name} ({attribute.interpolation}) has {found} values; {wanted} were expected"


def _extent_errors(prim: Prim, points: np.ndarray) -> Iterator[str]:
    box = _rows(prim, "extent")
    if box is None or box.shape != (2, 3):
        yield "the extent is missing"
    elif len(points) and not ((box[0] <= points).all() and (points <= box[1]).all()):
        yield "points lie outside the extent"


def _rows(prim: Prim, name: str) -> np.ndarray | None:
    attribute = prim.attributes.get(name)
    return attribute.value if attribute is not None and isinstance(attribute.value, np.ndarray) else None


def _token(prim: Prim, name: str) -> object:
    attribute = prim.attributes.get(name)
    return attribute.value if attribute is not None else None
