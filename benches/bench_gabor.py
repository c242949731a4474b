"""Speed of the Gabor bank against OpenCV's `filter2D` with the same kernels, and distance from the arithmetic limit."""

import math
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np

from tress.kernel.image import GaborSizes, gabor_responses, orient

ORIENTATIONS = 32


@dataclass(frozen=True)
class GaborTime:
    """Seconds for one round over a square region, ours (orientation and confidence) and OpenCV's (responses alone).

    `folded_share` is the share of the plain correlation's multiplications that are left after folding by symmetry;
    `products_per_sec` how many of those left are done in a second.
    """

    name: str
    ours_secs: float
    filter2d_secs: float
    folded_share: float
    products_per_sec: float

    @property
    def ratio(self) -> float:
        """How many times as long OpenCV takes."""
        return self.filter2d_secs / self.ours_secs


def gabor_time(name: str, sizes: GaborSizes, *, side: int = 500, repeats: int = 3) -> GaborTime:
    """Times both on the same random picture of `side` x `side` px; medians of `repeats` runs, taken in turns."""
    image = np.random.default_rng(0).random((side, side)).astype(np.float32)
    mask = np.ones(image.shape, bool)
    kernels = bank_kernels(sizes)
    ours, theirs = [], []
    for _ in range(repeats):
        ours.append(_seconds(lambda: orient(image, mask=mask, sizes=[sizes])))
        theirs.append(_seconds(lambda: [cv2.filter2D(image, cv2.CV_32F, kernel) for kernel in kernels]))
    taps = folded_taps(sizes)
    products = taps * 4 * math.ceil((ORIENTATIONS // 4 + 1) / 3) * 3
    plain = ORIENTATIONS * kernels[0].size
    ours_secs = statistics.median(ours)
    return GaborTime(name, ours_secs, statistics.median(theirs), products / plain, products * image.size / ours_secs)


def bank_kernels(sizes: GaborSizes) -> list[np.ndarray]:
    """The bank's kernels, read off as its answers to a single bright pixel; they are even, so no flip is needed."""
    radius = kernel_radius(sizes)
    impulse = np.zeros((4 * radius + 1, 4 * radius + 1))
    impulse[2 * radius, 2 * radius] = 1
    inner = slice(radius, 3 * radius + 1)
    return [np.ascontiguousarray(kernel[inner, inner]) for kernel in gabor_responses(impulse, sizes=sizes)]


def kernel_radius(sizes: GaborSizes) -> int:
    """Pixels from the middle of a kernel to its border."""
    return math.ceil(2.5 * max(sizes.sigma_u, sizes.sigma_v))


def folded_taps(sizes: GaborSizes) -> int:
    """Pixels (u, v), 0 <= v <= u, of the kernels' disc: one for each eight."""
    radius = kernel_radius(sizes)
    return sum(u * u + v * v <= radius * radius for u in range(radius + 1) for v in range(u + 1))


def gabor_times() -> list[GaborTime]:
    """The paper's kernels, and those three times as long that are the default for photographs."""
    return [
        gabor_time("paper", GaborSizes()),
        gabor_time("stretched", GaborSizes(sigma_v=7.2)),
    ]


def _seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def main() -> None:
    """Prints the seconds of both banks beside OpenCV's filter2D."""
    for row in gabor_times():
        print(
            f"{row.name}: {row.ours_secs:.3f} s, filter2D {row.filter2d_secs:.3f} s, ratio {row.ratio:.1f}, "
            f"{100 * row.folded_share:.0f} % of the products, {row.products_per_sec / 1e9:.1f} G/s"
        )


if __name__ == "__main__":
    main()
