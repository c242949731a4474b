"""Names for parts of the head: masks in [0, 1] at the vertices of the cut mesh.

Face, ears, lips and eyelids come from MakeHuman's own uv masks. No scalp is marked anywhere: it is what lies above a
hairline, given as knots of azimuth and elevation around the skull's centre. The neck lies under a slanted plane from
below the chin to the nape.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from tools.assets.cut import HeadCut
from tools.assets.makehuman import MakeHuman

HAIRLINE_DEG = np.array(
    [
        (0.0, 29.0),
        (18.0, 30.0),
        (34.0, 32.0),
        (46.0, 25.0),
        (56.0, 10.0),
        (63.0, -6.0),
        (69.0, -22.0),
        (75.0, -20.0),
        (81.0, -6.0),
        (102.0, -8.0),
        (120.0, -34.0),
        (180.0, -44.0),
    ]
)
"""Azimuth from the front to either side, and elevation, degrees: forehead, temple, sideburn, over the ear, nape."""
HAIRLINE_SOFTNESS_DEG = 4.0
SKULL_CENTER_M = np.array([0.0, 0.750, 0.050])
"""Centre of the skull in MakeHuman's base mesh."""
NECK_LINE_M = ((0.100, 0.612), (-0.015, 0.672))
"""Two points (z, y) of the base mesh on the plane above the neck: below the chin, and at the nape."""


def regions(source: MakeHuman, cut: HeadCut) -> Mapping[str, NDArray[np.float32]]:
    """Masks (V,) float32: scalp, face, ears, lips, eyes (lids, sockets and balls), neck, inside (mouth bag and
    sockets).
    """
    positions = source.mesh.positions[cut.vertices]
    eyeballs = np.arange(len(cut.vertices)) >= cut.skin_count
    painted = {name: _sampled(source.masks[name], source, cut) for name in ("face", "ears", "lips", "eyelids")}
    inside = np.where(eyeballs, 0.0, _pockets(source, cut))
    mouth = inside * _sampled(source.masks["inside-mouth"], source, cut)
    outer = (1 - inside) * ~eyeballs
    neck = _neck(positions) * outer
    masks = {
        "scalp": scalp(positions) * (1 - painted["ears"]) * (1 - neck) * outer,
        "face": painted["face"] * outer,
        "ears": painted["ears"] * outer,
        "lips": painted["lips"] * outer,
        "eyes": np.maximum.reduce([painted["eyelids"], inside - mouth, eyeballs.astype(float)]),
        "neck": neck,
        "inside": inside,
    }
    return {name: np.clip(mask, 0, 1).astype(np.float32) for name, mask in masks.items()}


def scalp(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """1 above the hairline, 0 below it, a soft step between: (V,) for positions (V, 3) of the base mesh."""
    x, y, z = (positions - SKULL_CENTER_M).T
    azimuth = np.degrees(np.arctan2(np.abs(x), z))
    elevation = np.degrees(np.arctan2(y, np.hypot(x, z)))
    above = elevation - np.interp(azimuth, HAIRLINE_DEG[:, 0], HAIRLINE_DEG[:, 1])
    return _smooth_step(above / HAIRLINE_SOFTNESS_DEG)


def charts(source: MakeHuman, cut: HeadCut) -> NDArray[np.int64]:
    """The uv chart of each face (Q,): faces whose corners share uv indices hang together. Largest chart first."""
    first = np.repeat(cut.corner_uv[:, :1], 3, axis=1).ravel()
    rest = cut.corner_uv[:, 1:].ravel()
    count = len(source.mesh.uv)
    _, label = connected_components(
        coo_array((np.ones(len(first)), (first, rest)), shape=(count, count)), directed=False
    )
    of_face = label[cut.corner_uv[:, 0]]
    names, inverse, sizes = np.unique(of_face, return_inverse=True, return_counts=True)
    rank = np.empty(len(names), np.int64)
    rank[np.argsort(-sizes, kind="stable")] = np.arange(len(names))
    return rank[inverse]


def _pockets(source: MakeHuman, cut: HeadCut) -> NDArray[np.float64]:
    """1 where all faces around a vertex lie in uv charts other than head and neck: mouth bag and eye sockets."""
    chart = charts(source, cut)
    outer_skin = np.isin(chart, _outer_charts(source, cut, chart))
    touches = np.zeros(len(cut.vertices))
    touches[cut.quads[outer_skin].ravel()] = 1
    return 1 - touches


def _outer_charts(source: MakeHuman, cut: HeadCut, chart: NDArray[np.int64]) -> list[int]:
    """The charts of the visible skin: the largest, and every one that holds the neck's rim."""
    height = source.mesh.positions[cut.vertices][cut.quads].mean(axis=1)[:, 1]
    return sorted({0, int(chart[np.argmin(height)])})


def _sampled(mask: NDArray[np.float64], source: MakeHuman, cut: HeadCut) -> NDArray[np.float64]:
    """A uv mask at the vertices: the mean over a vertex's corners."""
    size = np.array(mask.shape[::-1])
    uv = source.mesh.uv[cut.corner_uv.ravel()]
    column, row = np.clip((uv * [1, -1] + [0, 1]) * size, 0, size - 1).astype(int).T
    total = np.bincount(cut.quads.ravel(), weights=mask[row, column], minlength=len(cut.vertices))
    return total / np.bincount(cut.quads.ravel(), minlength=len(cut.vertices)).clip(min=1)


def _neck(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    (z0, y0), (z1, y1) = NECK_LINE_M
    limit = y0 + (positions[:, 2] - z0) * (y1 - y0) / (z1 - z0)
    return _smooth_step((limit - positions[:, 1]) / 0.008)


def _smooth_step(value: NDArray[np.float64]) -> NDArray[np.float64]:
    t = np.clip(0.5 + 0.5 * value, 0, 1)
    return t * t * (3 - 2 * t)
