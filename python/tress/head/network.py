"""What Tress asks of the three small networks, and how OpenCV's dnn runs the built ones.

Anything with these methods can take a network's place: a user with better models passes objects of their own.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.base.errors import AssetMissingError, FormatError
from tress.head.crop import Crop
from tress.head.face import FaceBox
from tress.head.landmarks import FaceLandmarks


class FaceDetector(Protocol):
    """Finds faces in a picture."""

    def detect(self, image: NDArray[np.uint8]) -> list[FaceBox]:
        """The faces of `image` (H, W, 3) uint8 sRGB, surest first; empty where there is none."""
        ...


class LandmarkModel(Protocol):
    """Puts the 468 points of the MediaPipe face mesh on one face."""

    def landmarks(self, image: NDArray[np.uint8], crop: Crop) -> FaceLandmarks:
        """The points of the face that fills `crop` of `image` (H, W, 3) uint8 sRGB."""
        ...


class PersonSegmenter(Protocol):
    """Tells people from their surroundings."""

    def probability(self, image: NDArray[np.uint8]) -> NDArray[np.float32]:
        """The probability of a person at every pixel of `image` (H, W, 3) uint8 sRGB: (H, W) float32 in [0, 1]."""
        ...


class Network:
    """A TFLite network read by OpenCV's dnn.

    OpenCV 5's new engine silently drops outputs of these networks: its classic engine is asked for where there is a
    choice.
    Raises `AssetMissingError` where the file is absent, `FormatError` where OpenCV cannot read it.
    """

    def __init__(self, path: Path) -> None:
        if not path.is_file():
            raise AssetMissingError(f"The network {path} is missing; name another file or run `make assets`.")
        classic = getattr(cv2.dnn, "ENGINE_CLASSIC", None)
        options = [] if classic is None else [classic]
        try:
            self._net: Any = cv2.dnn.readNetFromTFLite(str(path), *options)
        except cv2.error as error:
            raise FormatError(f"{path} is not a TFLite network that OpenCV {cv2.__version__} can run.") from error
        self._outputs: Sequence[str] = self._net.getUnconnectedOutLayersNames()

    def __call__(self, batch: NDArray[np.float32]) -> list[NDArray[np.float32]]:
        """All outputs for `batch` (1, 3, H, W) float32, largest first: names differ between releases of OpenCV."""
        self._net.setInput(batch)
        outputs = [np.asarray(output, np.float32) for output in self._net.forward(self._outputs)]
        return sorted(outputs, key=lambda output: -output.size)
