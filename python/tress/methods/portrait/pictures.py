"""The pictures of the stages: what each decided, to look at. All are (H, W, 3) uint8 sRGB."""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.color import linear_to_srgb8

Picture = NDArray[np.uint8]

_GREY: Final = 0.18
"""Linear light of the grey that cut-out hair is shown on."""
_SAMPLE_PX: Final = 0.7
_LAYER_COLORS: Final = np.array([[40, 60, 160], [60, 160, 60], [220, 180, 40], [200, 40, 40]], np.uint8)
"""Background blue, body green, face yellow, hair red: the colours of strokes."""


def layers_picture(pixels: Picture, *, label: NDArray[np.uint8]) -> Picture:
    """The layers in colour over the photo, with their borders in white."""
    shown = (0.55 * pixels + 0.45 * _LAYER_COLORS[label]).astype(np.uint8)
    edges = cv2.morphologyEx(label, cv2.MORPH_GRADIENT, np.ones((3, 3), np.uint8)) > 0
    shown[edges] = 255
    return shown


def matte_picture(alpha: NDArray[np.float32], *, foreground: NDArray[np.float32]) -> Picture:
    """Beside each other: alpha, and the hair alone on neutral grey. `foreground` (H, W, 3) linear."""
    cut_out = np.empty((*alpha.shape, 3), np.uint8)
    cut_out[:] = linear_to_srgb8(np.array(_GREY))
    shown, share = alpha > 0, alpha[alpha > 0, None]
    cut_out[shown] = linear_to_srgb8(share * foreground[shown] + (1 - share) * _GREY)
    grey = np.repeat(np.rint(alpha * 255).astype(np.uint8)[..., None], 3, axis=2)
    return np.hstack([grey, cut_out])


def orientation_picture(angle: NDArray[np.floating], *, confidence: NDArray[np.floating]) -> Picture:
    """Direction of the strands as hue (red: horizontal, going round once in π), confidence as brightness."""
    hue = np.nan_to_num(angle) % np.pi / np.pi * 180
    value = np.where(np.isfinite(angle), np.clip(confidence, 0, 1) ** 0.5, 0) * 255
    hsv = np.stack([hue, np.full_like(hue, 220), value], axis=-1).astype(np.uint8)
    return np.asarray(cv2.cvtColor(hsv, cv2.COLOR_HSV2RGB), np.uint8)


def strands_picture(
    points: NDArray[np.floating],
    *,
    offsets: NDArray[np.integer],
    colors: NDArray[np.uint8],
    shape: tuple[int, int],
    depth: NDArray[np.floating] | None = None,
) -> Picture:
    """Polylines `points` (N, 2) px on black, each segment in the colour (N, 3) of its first point.

    With `depth` (N,) towards the camera, nearer segments lie over farther ones; otherwise later over earlier.
    """
    picture = np.zeros((*shape, 3), np.uint8)
    last = np.zeros(len(points), np.bool_)
    last[np.asarray(offsets[1:]) - 1] = True
    first = np.flatnonzero(~last)
    if depth is not None:
        first = first[np.argsort(depth[first], kind="stable")]
    step = points[first + 1] - points[first]
    count = np.maximum(np.ceil(np.linalg.norm(step, axis=1) / _SAMPLE_PX).astype(np.int64), 1)
    segment = np.repeat(np.arange(len(first)), count)
    part = (np.arange(len(segment)) - np.repeat(np.cumsum(count) - count, count)) / count[segment]
    column, row = np.floor(points[first[segment]] + part[:, None] * step[segment]).astype(np.int64).T
    inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
    picture[row[inside], column[inside]] = colors[first[segment[inside]]]
    return picture


def thinned(offsets: NDArray[np.integer], *, most_strands: int = 6000) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Every so many-th strand, at most so many: the indices of their points, and their own offsets.

    >>> [part.tolist() for part in thinned(np.array([0, 2, 5, 7]), most_strands=2)]
    [[0, 1, 5, 6], [0, 2, 4]]
    """
    begins = np.asarray(offsets, np.int64)
    strands = np.arange(0, len(begins) - 1, max(1, -(-(len(begins) - 1) // most_strands)))
    counts = begins[strands + 1] - begins[strands]
    kept = np.concatenate([np.zeros(1, np.int64), np.cumsum(counts)])
    return np.arange(kept[-1]) + np.repeat(begins[strands] - kept[:-1], counts), kept


def depth_colors(depth: NDArray[np.floating]) -> NDArray[np.uint8]:
    """A colour (N, 3) for every depth (N,) towards the camera, far violet to near yellow."""
    finite = depth[np.isfinite(depth)]
    low, high = np.percentile(finite, [1, 99]) if len(finite) else (0.0, 1.0)
    level = np.clip((np.nan_to_num(depth) - low) / max(high - low, 1e-9), 0, 1)
    table = cv2.applyColorMap(np.arange(256, dtype=np.uint8)[:, None], cv2.COLORMAP_PLASMA)[:, 0, ::-1]
    return np.asarray(table[(level * 255).astype(np.uint8)], np.uint8)


def mesh_picture(
    pixels: Picture, *, xy_px: NDArray[np.floating], triangles: NDArray[np.integer], landmarks_px: NDArray[np.floating]
) -> Picture:
    """Edges of the triangles that face the camera, and the landmarks, over the photo."""
    shown = pixels.copy()
    corners = xy_px[triangles]
    side, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    facing = side[:, 0] * other[:, 1] - side[:, 1] * other[:, 0] < 0  # y down turns counter-clockwise round
    polygons = np.rint((corners[facing] - 0.5) * 16).astype(np.int32)
    cv2.polylines(
        shown, list(polygons), isClosed=True, color=(90, 200, 255), thickness=1, lineType=cv2.LINE_AA, shift=4
    )
    shown = (0.5 * pixels + 0.5 * shown).astype(np.uint8)
    for x, y in np.rint((landmarks_px[:, :2] - 0.5) * 16).astype(int).tolist():
        cv2.circle(shown, (x, y), 16, (255, 80, 80), -1, cv2.LINE_AA, 4)
    return shown
