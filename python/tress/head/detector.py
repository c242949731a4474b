"""Face detection by MediaPipe's short-range network: a single-shot detector with 896 fixed anchors.

The network looks at 128 x 128 pixels. Each anchor votes for a box and six points; votes that overlap are averaged by
their score (blind suppression would make the box jitter). Faces under about a tenth of the picture are too small for
it; `find_faces` looks again in overlapping parts of the picture, and in a wider frame for faces that fill it.
Source: Bazarevsky et al. 2019, BlazeFace.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from tress.head.assets import asset
from tress.head.crop import Crop
from tress.head.face import FaceBox
from tress.head.network import FaceDetector, Network

SIDE = 128
GRIDS = ((16, 2), (8, 6))
"""Cells a side and anchors a cell of the two feature maps."""


class OpenCvFaceDetector:
    """The built short-range detector, or another TFLite file of the same form."""

    def __init__(self, path: Path | None = None, *, min_score: float = 0.5, overlap: float = 0.3) -> None:
        self._network = Network(path or asset("face_detection_short_range.tflite"))
        self._anchors = anchors()
        self._min_score = min_score
        self._overlap = overlap

    def detect(self, image: NDArray[np.uint8]) -> list[FaceBox]:
        """The faces of `image` (H, W, 3) uint8 sRGB, surest first. About 5 ms."""
        height, width = image.shape[:2]
        crop = Crop(center=(width / 2, height / 2), size=float(max(height, width)), angle=0.0)
        pixels = crop.pixels(image, side=SIDE)
        batch = cv2.dnn.blobFromImage(pixels, 1 / 127.5, (SIDE, SIDE), (127.5, 127.5, 127.5))
        boxes, scores = self._network(np.asarray(batch, np.float32))
        score = expit(scores.reshape(-1).astype(np.float64))
        sure = score >= self._min_score
        points = boxes.reshape(len(score), 8, 2)[sure].astype(np.float64) / SIDE
        points[:, 0] += self._anchors[sure]
        points[:, 2:] += self._anchors[sure][:, None]
        merged = merge_votes(points, score[sure], overlap=self._overlap)
        return [_face(votes, total, crop) for votes, total in merged]


def anchors() -> NDArray[np.float64]:
    """Centres of the 896 anchors (896, 2) in the unit square, row by row, all anchors of a cell together."""
    parts = []
    for cells, repeats in GRIDS:
        ticks = (np.arange(cells) + 0.5) / cells
        x, y = np.meshgrid(ticks, ticks)
        parts.append(np.repeat(np.stack([x, y], axis=-1).reshape(-1, 2), repeats, axis=0))
    return np.concatenate(parts)


def merge_votes(
    points: NDArray[np.float64], score: NDArray[np.floating], *, overlap: float
) -> list[tuple[NDArray[np.float64], float]]:
    """Groups votes (N, 8, 2) (centre, size, six points) whose boxes overlap, averages each group by score.

    Returns the averaged votes (8, 2) with the group's best score, surest first.
    """
    rest = np.argsort(-score, kind="stable")
    merged = []
    while rest.size:
        same = intersection_over_union(points[rest[0]], points[rest]) >= overlap
        same[0] = True
        group = rest[same]
        weight = score[group] / score[group].sum()
        merged.append((np.tensordot(weight, points[group], axes=1), float(score[rest[0]])))
        rest = rest[~same]
    return merged


def intersection_over_union(one: NDArray[np.float64], many: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of the box (centre, size) in `one` (8, 2) with each of `many` (N, 8, 2): (N,) in [0, 1]."""
    low = np.maximum(one[0] - one[1] / 2, many[:, 0] - many[:, 1] / 2)
    high = np.minimum(one[0] + one[1] / 2, many[:, 0] + many[:, 1] / 2)
    shared = np.prod(np.maximum(high - low, 0), axis=1)
    total = np.prod(one[1]) + np.prod(many[:, 1], axis=1) - shared
    return shared / np.maximum(total, 1e-12)


def find_faces(
    image: NDArray[np.uint8],
    *,
    detector: FaceDetector,
    count: int = 1,
    confirmed: Callable[[FaceBox], bool] | None = None,
) -> list[FaceBox]:
    """The faces of `image` (H, W, 3) uint8 sRGB: in the whole, then in a wider frame, in halves and in quarters, until
    there are `count` of them.

    `confirmed` has the last word on each: small parts of a picture often look like faces to the detector alone.
    Cost: one detection where the whole picture shows enough faces, at most 60.
    """
    found: list[FaceBox] = []
    for crops in _looks(*image.shape[:2]):
        fresh = _without_doubles([*found, *_detect_in(image, crops, detector)])[len(found) :]
        found += [face for face in fresh if confirmed is None or confirmed(face)]
        if len(found) >= count:
            break
    return found


def _looks(height: int, width: int) -> Iterator[list[Crop]]:
    longer = float(max(height, width))
    middle = (width / 2, height / 2)
    yield [Crop(middle, longer, 0.0)]
    yield [Crop(middle, 1.7 * longer, 0.0)]
    for part in (0.5, 0.25):
        if part * longer >= SIDE / 2:
            yield _tiles(height, width, size=part * longer)


def _tiles(height: int, width: int, *, size: float) -> list[Crop]:
    def centers(length: int) -> NDArray[np.float64]:
        if length <= size:
            return np.array([length / 2])
        count = int(np.ceil((length - size) / (size / 2))) + 1
        return np.linspace(size / 2, length - size / 2, count)

    return [Crop((float(x), float(y)), size, 0.0) for y in centers(height) for x in centers(width)]


def _detect_in(image: NDArray[np.uint8], crops: list[Crop], detector: FaceDetector) -> list[FaceBox]:
    found = []
    for crop in crops:
        side = round(min(crop.size, 4 * SIDE))
        found += [_moved(face, crop, side) for face in detector.detect(crop.pixels(image, side=side))]
    return sorted(found, key=lambda face: -face.score)


def _without_doubles(faces: list[FaceBox]) -> list[FaceBox]:
    """`faces` without those that lie on an earlier one."""
    kept: list[FaceBox] = []
    for face in faces:
        if all(np.linalg.norm(face.center - other.center) > 0.5 * max(face.size, other.size) for other in kept):
            kept.append(face)
    return kept


def _moved(face: FaceBox, crop: Crop, side: int) -> FaceBox:
    corners = crop.to_image(np.array(face.box).reshape(2, 2) / side)
    x0, y0, x1, y1 = (float(value) for value in corners.ravel())
    return FaceBox((x0, y0, x1, y1), crop.to_image(face.keypoints / side), face.score)


def _face(votes: NDArray[np.float64], score: float, crop: Crop) -> FaceBox:
    low, high = crop.to_image(np.stack([votes[0] - votes[1] / 2, votes[0] + votes[1] / 2]))
    box = (float(low[0]), float(low[1]), float(high[0]), float(high[1]))
    return FaceBox(box, crop.to_image(votes[2:]), score)
