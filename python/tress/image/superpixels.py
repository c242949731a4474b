"""Superpixels of a photograph with their colour, fine texture and neighbours.

A graph cut over 4,000 superpixels takes a hundredth of the time of one over a million pixels, and a patch of hair shows
a texture that a single pixel does not have.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from skimage.segmentation import slic

from tress.base.parallel import together
from tress.image.color import lab_of_srgb

_ITERATIONS = 4
_FLAT_ENERGY = 4.0


@dataclass(frozen=True)
class Superpixels:
    """A photograph cut into N patches, at a working size (h, w).

    `label` (h, w) int32: the patch of every pixel. `area` (N,) pixels. `center` (N, 2) float32 (x, y) in working
    pixels. `lab` (N, 3) float32: mean CIE Lab. `texture` (N,) float32: logarithm of the mean fine contrast in L.
    `grain` (N,) float32 in [0, 1]: how much the fine edges run the same way. `edges` (E, 2) int32: neighbours, each
    pair once, first < second. `border` (E,) float32: length of their common border, pixels.
    """

    label: NDArray[np.int32]
    area: NDArray[np.float32]
    center: NDArray[np.float32]
    lab: NDArray[np.float32]
    texture: NDArray[np.float32]
    grain: NDArray[np.float32]
    edges: NDArray[np.int32]
    border: NDArray[np.float32]

    @property
    def count(self) -> int:
        """Number of patches N."""
        return len(self.area)


def superpixels(image: NDArray[np.uint8], *, count: int, compactness: float) -> Superpixels:
    """Cuts `image` (h, w, 3) uint8 sRGB into about `count` patches by SLIC (Achanta et al. 2012).

    `compactness` weighs distance in pixels against distance in Lab. Deterministic. Cost: about 0.1 s for 640 x 640
    pixels.
    """
    lab = lab_of_srgb(image)
    (contrast, grains), label = together(
        lambda: (_fine_contrast(lab[..., 0]), _grain(lab[..., 0])), lambda: _patches(lab, count, compactness)
    )
    number = int(label.max()) + 1
    area = np.bincount(label.ravel(), minlength=number).astype(np.float32)
    texture = np.log(mean_over(label, contrast, area) + 0.3)
    grain = mean_over(label, grains, area)
    edges, border = _neighbours(label, number)
    return Superpixels(label, area, _centers(label, area), mean_over(label, lab, area), texture, grain, edges, border)


def _patches(lab: NDArray[np.float32], count: int, compactness: float) -> NDArray[np.int32]:
    label = slic(
        lab,
        n_segments=count,
        compactness=compactness / max(float(np.ptp(lab)), 1.0),  # `slic` first scales the values to [0, 1]
        max_num_iter=_ITERATIONS,
        convert2lab=False,
        start_label=0,
        channel_axis=-1,
    )
    return label.astype(np.int32)


def mean_over(label: NDArray[np.int32], values: NDArray[np.float32], area: NDArray[np.float32]) -> NDArray[np.float32]:
    """Mean of `values` (h, w) or (h, w, C) over every patch: (N,) or (N, C) float32."""
    flat = label.ravel()
    channels = values.reshape(len(flat), -1)
    sums = [np.bincount(flat, weights=channels[:, c], minlength=len(area)) for c in range(channels.shape[1])]
    means = (np.stack(sums, axis=1) / area[:, None]).astype(np.float32)
    return means[:, 0] if values.ndim == 2 else means


def _fine_contrast(lightness: NDArray[np.float32]) -> NDArray[np.float32]:
    detail = np.abs(lightness - cv2.GaussianBlur(lightness, (0, 0), 1.5))
    return cv2.GaussianBlur(detail, (0, 0), 2.0)  # type: ignore[return-value]


def _grain(lightness: NDArray[np.float32]) -> NDArray[np.float32]:
    """How much all fine edges around a pixel run the same way, in [0, 1]: coherence of the structure tensor."""
    across = cv2.Sobel(lightness, cv2.CV_32F, 1, 0)
    down = cv2.Sobel(lightness, cv2.CV_32F, 0, 1)
    tensor = cv2.GaussianBlur(np.dstack([across * across, down * down, across * down]), (0, 0), 4.0)
    along = np.hypot(tensor[..., 0] - tensor[..., 1], 2 * tensor[..., 2])
    return np.asarray(along / (tensor[..., 0] + tensor[..., 1] + _FLAT_ENERGY), np.float32)


def _centers(label: NDArray[np.int32], area: NDArray[np.float32]) -> NDArray[np.float32]:
    rows, columns = np.indices(label.shape, dtype=np.float32)
    return mean_over(label, np.stack([columns + 0.5, rows + 0.5], axis=-1), area)


def _neighbours(label: NDArray[np.int32], number: int) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    pairs = [
        (label[:, :-1].ravel(), label[:, 1:].ravel()),
        (label[:-1].ravel(), label[1:].ravel()),
    ]
    first = np.concatenate([a for a, _ in pairs]).astype(np.int64)
    second = np.concatenate([b for _, b in pairs]).astype(np.int64)
    differ = first != second
    low, high = np.minimum(first, second)[differ], np.maximum(first, second)[differ]
    code, length = np.unique(low * number + high, return_counts=True)
    edges = np.stack([code // number, code % number], axis=1).astype(np.int32)
    return edges, length.astype(np.float32)
