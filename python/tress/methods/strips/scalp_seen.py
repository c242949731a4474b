"""How much of the scalp shows between the strips of a hairdo, as an engine draws them: with an alpha test."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from tress.kernel import raster
from tress.kernel.raster import OPAQUE, Cutouts
from tress.methods.strips.bald_document import HEAD
from tress.model.attachment import surface_mesh
from tress.model.document import Document
from tress.model.mesh import Mesh
from tress.model.strip import Strip
from tress.model.strip_mesh import strips_mesh

Array = np.ndarray[Any, Any]

WITHIN = 0.9
"""Of the mask `scalp`: the hairline itself, where skin may show, is left out."""
THRESHOLD = 0.5
PICTURE_PX = 320
VIEWS: Final[Mapping[str, tuple[float, float]]] = {
    "top": (0.0, 90.0),
    "front": (0.0, 40.0),
    "left": (90.0, 15.0),
    "back": (180.0, 0.0),
    "crown": (180.0, 45.0),
    "right": (-90.0, 15.0),
}
"""Name, and degrees around to the head's left and upwards."""


def scalp_seen(document: Document, *, threshold: float = THRESHOLD) -> dict[str, float]:
    """The share of the scalp's pixels that show skin, by view: 0 where hair covers it, 1 for a bald head.

    The alphas of the atlas are tested at `threshold`, as engines do by default. About 0.3 s.
    """
    head = surface_mesh(document, HEAD, where="A scalp")
    within = np.all(head.vertex_attributes["scalp"][head.triangles] > WITHIN, axis=1)
    hair = strips_mesh(document, names=sorted(document.of_type(Strip)))
    positions = np.concatenate([head.positions, hair.positions])
    triangles = np.concatenate([head.triangles, hair.triangles + len(head.positions)])
    cutouts = _tested(hair, len(head.triangles), threshold)
    found = {}
    for name, (azimuth, elevation) in VIEWS.items():
        camera = _camera(head.positions, np.radians(azimuth), np.radians(elevation))
        bald = _weights(head.positions, head.triangles, camera, OPAQUE)[within].sum()
        shown = _weights(positions, triangles, camera, cutouts)[: len(within)][within].sum()
        found[name] = float(shown / bald)
    return found


def _tested(hair: Mesh, before: int, threshold: float) -> Cutouts:
    """The texture's alpha as all or nothing, on the triangles that follow `before` opaque ones."""
    if hair.texture is None or hair.corner_uv is None or hair.texture.pixels.shape[2] < 4:
        return OPAQUE
    alpha = np.where(hair.texture.pixels[..., 3] >= 255 * threshold, 255, 0).astype(np.uint8)
    of_triangle = np.concatenate([np.full(before, -1, np.int32), np.zeros(len(hair.triangles), np.int32)])
    corner_uv = np.concatenate([np.zeros((before, 3, 2), np.float32), hair.corner_uv.astype(np.float32)])
    return Cutouts([alpha], of_triangle, corner_uv)


def _camera(positions: Array, azimuth: float, elevation: float) -> Array:
    """(3, 4) orthographic, the whole of the positions in the picture."""
    away = -np.array([np.sin(azimuth) * np.cos(elevation), np.sin(elevation), np.cos(azimuth) * np.cos(elevation)])
    right = np.array([np.cos(azimuth), 0.0, -np.sin(azimuth)])
    low, high = positions.min(axis=0), positions.max(axis=0)
    rows = PICTURE_PX / float(np.linalg.norm(high - low)) * np.stack([right, np.cross(away, right)])
    middle = PICTURE_PX / 2 - rows @ (0.5 * (low + high))
    return np.vstack([np.column_stack([rows, middle]), [0, 0, 0, 1]])


def _weights(positions: Array, triangles: Array, camera: Array, cutouts: Cutouts) -> Array:
    """(F,) pixels that show each triangle."""
    fragments = raster.rasterise(
        np.zeros((0, 4)),
        offsets=np.zeros(1, np.int64),
        half_width_px=np.zeros(0),
        alpha=np.zeros(0),
        mesh_vertices=raster.project(positions, xy_from_points=camera),
        triangles=triangles,
        cutouts=cutouts,
        width=PICTURE_PX,
        height=PICTURE_PX,
    )
    return np.bincount(fragments.primitive, weights=fragments.weight, minlength=len(triangles))
