"""The matte against PyMatting: the same alpha and colours, timed in the same run."""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.image.unmix import unmixed
from tress.kernel.matting import closed_form_alpha


@dataclass(frozen=True)
class MatteTimes:
    """Seconds of either side, their ratio (above 1: ours is faster) and the mean difference of the two alphas."""

    ours_secs: float
    pymatting_secs: float
    ratio: float
    mean_difference: float


def matte_times(side: int = 400) -> MatteTimes:
    """Alpha and colours of a soft disk with hairs, `side` x `side` px; PyMatting compiles before its time is taken."""
    import pymatting

    image, trimap = _scene(side)
    known = np.where(trimap == 128, 0.5, trimap / 255)

    def ours() -> NDArray[np.float32]:
        alpha = closed_form_alpha(image, trimap=trimap, epsilon=1e-6, tolerance=1e-4).alpha
        unmixed(image.astype(np.float32), alpha=alpha)
        return alpha

    def theirs() -> NDArray[np.float64]:
        alpha = pymatting.estimate_alpha_cf(image, known, laplacian_kwargs={"epsilon": 1e-6})
        pymatting.estimate_foreground_ml(image, alpha, return_background=True)
        return alpha

    small = slice(0, side // 4)
    pymatting.estimate_foreground_ml(image[small], np.clip(known[small], 0, 1), return_background=True)
    pymatting.estimate_alpha_cf(image, known, laplacian_kwargs={"epsilon": 1e-6})
    (ours_secs, alpha), (theirs_secs, reference) = _timed(ours), _timed(theirs)
    difference = float(np.abs(alpha - reference)[trimap == 128].mean())
    return MatteTimes(ours_secs, theirs_secs, theirs_secs / ours_secs, difference)


def _timed(work: Callable[[], NDArray[np.floating]]) -> tuple[float, NDArray[np.floating]]:
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def _scene(side: int) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    rows, columns = np.indices((side, side)) / side - 0.5
    distance, angle = np.hypot(rows, columns), np.arctan2(rows, columns)
    alpha = np.clip((0.33 + 0.05 * np.sin(60 * angle) - distance) / 0.03 + 0.5, 0, 1)
    front = np.array([0.4, 0.25, 0.15]) * (1 + 0.3 * np.sin(200 * angle))[..., None]
    back = np.array([0.5, 0.7, 0.8]) + 0.1 * np.sin(20 * columns)[..., None]
    trimap = np.full((side, side), 128, np.uint8)
    trimap[distance < 0.24] = 255
    trimap[distance > 0.42] = 0
    return alpha[..., None] * front + (1 - alpha[..., None]) * back, trimap


def main() -> None:
    """Prints the seconds of both, their ratio and how far the alphas are apart."""
    times = matte_times()
    print(
        f"matte: {times.ours_secs:.2f} s, PyMatting {times.pymatting_secs:.2f} s, ratio {times.ratio:.1f}; "
        f"alphas apart by {times.mean_difference:.5f} in the mean"
    )


if __name__ == "__main__":
    main()
