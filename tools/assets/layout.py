"""The head's own uv layout: MakeHuman's charts of head, neck, pockets and eyes, packed without the body, the face
enlarged.

In MakeHuman's layout the face takes a hundredth of the square. Here the head's chart is laid on its side over the
whole width and widened around the face by a radial map r -> r (1 + gain exp(-(r/reach)^2)), which stays one to one for
gains below about 2.2; the other charts are set on shelves below it, the eyeballs and the mouth enlarged, for they are
what a portrait shows best.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tools.assets.cut import HeadCut
from tools.assets.makehuman import MakeHuman
from tools.assets.regions import charts

MARGIN = 0.006
FACE_GAIN = 1.4
FACE_REACH = 0.22
"""Of the head chart's width."""
EYE_GAIN = 8.0
"""Brings an iris from 5 to 40 texels of 1,024."""
MOUTH_GAIN = 1.6


def atlas(source: MakeHuman, cut: HeadCut, *, masks: Mapping[str, NDArray[np.float32]]) -> NDArray[np.float64]:
    """The uv of every corner (Q, 4, 2) in [0, 1], v up; `masks` (V,) by name: face, eyes and inside are enlarged."""
    uv = source.mesh.uv[cut.corner_uv]
    chart = charts(source, cut)
    turned = np.stack([uv[..., 1], -uv[..., 0]], axis=-1)
    head = chart == 0
    uv = np.where(head[:, None, None], _face_enlarged(turned, turned[head], masks["face"][cut.quads][head]), uv)
    gain = np.array([_gain(cut, chart == k, masks) for k in range(chart.max() + 1)])
    return _packed(uv * gain[chart][:, None, None], chart)


def _gain(cut: HeadCut, faces: NDArray[np.bool_], masks: Mapping[str, NDArray[np.float32]]) -> float:
    vertices = cut.quads[faces].ravel()
    if (vertices >= cut.skin_count).all():
        return EYE_GAIN
    mouth = masks["inside"][vertices].mean() > 0.5 and masks["eyes"][vertices].mean() < 0.5
    return MOUTH_GAIN if mouth else 1.0


def _face_enlarged(
    uv: NDArray[np.float64], head: NDArray[np.float64], face: NDArray[np.float32]
) -> NDArray[np.float64]:
    width = np.ptp(head[..., 0])
    center = (head * face[..., None]).sum(axis=(0, 1)) / face.sum()
    arm = uv - center
    radius = np.linalg.norm(arm, axis=-1, keepdims=True) / (FACE_REACH * width)
    return center + arm * (1 + FACE_GAIN * np.exp(-(radius**2)))


def _packed(uv: NDArray[np.float64], chart: NDArray[np.int64]) -> NDArray[np.float64]:
    """Charts on shelves, the first over the whole width, the rest by falling height; all keep their relative scale
    but the first."""
    out = np.empty_like(uv)
    scale = (1 - 2 * MARGIN) / np.ptp(uv[chart == 0][..., 0])
    left, top, shelf = MARGIN, 1 - MARGIN, 0.0
    order = sorted(range(1, chart.max() + 1), key=lambda k: -np.ptp(uv[chart == k][..., 1]))
    for k in [0, *order]:
        part = uv[chart == k] * (scale if k == 0 else 1.0)
        low, size = part.min(axis=(0, 1)), np.ptp(part, axis=(0, 1))
        if left + size[0] > 1 - MARGIN + 1e-9:
            left, top, shelf = MARGIN, top - shelf - MARGIN, 0.0
        out[chart == k] = part - low + [left, top - size[1]]
        left, shelf = left + size[0] + MARGIN, max(shelf, size[1])
    if top - shelf < 0:
        raise ValueError(f"The charts need {1 - top + shelf:.2f} of the square's height; at most 1 was expected.")
    return out
