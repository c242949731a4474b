"""Likeness of two pictures inside a mask."""

import cv2
import numpy as np
from numpy.typing import NDArray
from skimage.metrics import structural_similarity


def psnr_db(picture: NDArray[np.uint8], reference: NDArray[np.uint8], *, mask: NDArray[np.bool_]) -> float:
    """Peak signal-to-noise ratio in dB over the masked pixels of two (H, W, 3) sRGB pictures; 99 where they agree."""
    error = np.square(picture[mask].astype(np.float64) - reference[mask]).mean()
    return float(min(10 * np.log10(255**2 / max(error, 1e-12)), 99.0))


def ssim(picture: NDArray[np.uint8], reference: NDArray[np.uint8], *, mask: NDArray[np.bool_]) -> float:
    """Mean structural similarity of the luma over the masked pixels (Wang et al. 2004: Gaussian window, sigma 1.5)."""
    luma = np.array([0.299, 0.587, 0.114])
    _, similarity = structural_similarity(
        picture @ luma, reference @ luma, data_range=255, gaussian_weights=True, use_sample_covariance=False, full=True
    )
    return float(similarity[mask].mean())


def intersection_over_union(a: NDArray[np.bool_], b: NDArray[np.bool_]) -> float:
    """Share of the union of two masks that both cover; 1 for two empty masks."""
    union = int((a | b).sum())
    return float((a & b).sum() / union) if union else 1.0


def beside(mask: NDArray[np.bool_], *, part: float = 0.02) -> NDArray[np.bool_]:
    """The pixels outside the mask within a `part` of its picture's diagonal: where hair that spills is seen."""
    distance = cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 3)
    return ~mask & (distance <= part * np.hypot(*mask.shape))
