"""The person mask: which pixels belong to a person, hair included, by MediaPipe's selfie network."""

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.head.assets import asset
from tress.head.landmarks import FaceLandmarks
from tress.head.network import Network, PersonSegmenter

SIDE = 256


class OpenCvPersonSegmenter:
    """The built selfie network, or another TFLite file of the same form."""

    def __init__(self, path: Path | None = None) -> None:
        self._network = Network(path or asset("selfie_segmentation.tflite"))

    def probability(self, image: NDArray[np.uint8]) -> NDArray[np.float32]:
        """The probability of a person at every pixel of `image` (H, W, 3) uint8 sRGB: (H, W) float32 in [0, 1].

        The network sees 256 x 256 pixels: edges are soft over about 1/128 of the picture. About 20 ms.
        """
        height, width = image.shape[:2]
        small = cv2.resize(image, (SIDE, SIDE), interpolation=cv2.INTER_AREA)
        batch = cv2.dnn.blobFromImage(small, 1 / 255.0, (SIDE, SIDE))
        (output,) = self._network(np.asarray(batch, np.float32))[:1]
        mask = cv2.resize(output.reshape(SIDE, SIDE), (width, height), interpolation=cv2.INTER_LINEAR)
        return np.clip(np.asarray(mask, np.float32), 0.0, 1.0)


def person_mask(
    image: NDArray[np.uint8], *, landmarks: FaceLandmarks | None = None, segmenter: PersonSegmenter | None = None
) -> NDArray[np.float32]:
    """The probability of a person at every pixel of `image` (H, W, 3) uint8 sRGB: (H, W) float32 in [0, 1].

    With `landmarks` of a small face, the surroundings of that face are looked at once more from close by, which brings
    the mask's edge from 1/128 of the picture to about 1/25 of the face. 20 ms a look. Bystanders count as persons.
    """
    network = segmenter or OpenCvPersonSegmenter()
    mask = network.probability(image)
    if landmarks is None:
        return mask
    x0, x1, y0, y1 = _window(landmarks, image.shape[:2])
    if max(x1 - x0, y1 - y0) > 0.7 * max(image.shape[:2]):
        return mask
    near = network.probability(np.ascontiguousarray(image[y0:y1, x0:x1]))
    weight = _fading(near.shape, image.shape[:2], (x0, x1, y0, y1))
    mask = mask.copy()
    mask[y0:y1, x0:x1] += weight * (near - mask[y0:y1, x0:x1])
    return mask


def _window(landmarks: FaceLandmarks, shape: tuple[int, ...]) -> tuple[int, int, int, int]:
    x0, y0, x1, y1 = landmarks.box
    reach = 2.5 * max(x1 - x0, y1 - y0)
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    left, right = np.clip([round(x - reach), round(x + reach)], 0, shape[1])
    top, bottom = np.clip([round(y - reach), round(y + reach)], 0, shape[0])
    return int(left), int(right), int(top), int(bottom)


def _fading(shape: tuple[int, ...], whole: tuple[int, ...], window: tuple[int, int, int, int]) -> NDArray[np.float32]:
    """1 inside the window, falling to 0 at those of its edges that are not edges of the picture."""
    x0, x1, y0, y1 = window
    ramp = 0.1 * max(shape)
    inf = np.float32(np.inf)
    columns, rows = np.arange(shape[1]) + 0.5, np.arange(shape[0]) + 0.5
    across = np.minimum(columns if x0 > 0 else inf, shape[1] - columns if x1 < whole[1] else inf)
    down = np.minimum(rows if y0 > 0 else inf, shape[0] - rows if y1 < whole[0] else inf)
    across, down = np.broadcast_to(across, shape[1]), np.broadcast_to(down, shape[0])
    return np.clip(np.minimum(across[None, :], down[:, None]) / ramp, 0, 1).astype(np.float32)
