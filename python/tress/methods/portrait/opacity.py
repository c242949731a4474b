"""Opacity of the strands with which they cover each pixel of the photo as much as the matte says.

Several strands lie behind each other, and what shines through all of them is the product of what shines through each:
their optical depths, `-log(1 - alpha)`, add up. So the depth that a pixel lacks or has too much is handed to every
strand there as a factor. Without this, soft edges come out solid, and would have to take on the background's colour to
look like the photo.

Limits: strands are seen through 16 samples a pixel, so that more than 97 % coverage cannot be told from all of it; a
pixel that no strand crosses stays empty.
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.render.flat_scene import FlatScene
from tress.render.gbuffer import GBuffer, SceneOnScreen, hair_coverage, on_screen

_SOLID = 0.98
"""Matte from which hair counts as solid."""
_MOST_SEEN = 0.97
"""Coverage above which all samples may be taken."""
_LAYERS = 4.0
"""Strands that lie behind each other at a soft edge, to begin with."""
_BLUR_PX = 1.5
_NEAR_PX = 5
"""How far from a soft pixel its strands are looked for: half as long as segments are, and the reach of the blur."""
_FLOOR = 0.01
_LARGEST_FACTOR = 5.0


def with_fitted_opacity(
    flat: FlatScene,
    *,
    matte_alpha: NDArray[np.float32],
    covered: NDArray[np.bool_],
    on_skin: NDArray[np.bool_],
    xy_from_world: NDArray[np.float64],
    strand_bias_m: float,
    min_width_px: float,
    rounds: int,
) -> GBuffer:
    """What the photo's camera (3, 4) sees of the scene, in opacities that give the coverage `matte_alpha` (H, W).

    The new opacities (N,) are those of the GBuffer's scene. Hair behind the head, or in pixels `covered` (H, W) by face
    or body, does not show, and keeps its own; so does hidden hair `on_skin` (N,), lest the skull show bald from the
    side where it fills the outline. Costs a rasterisation, and one of the soft edges alone a round.
    """
    height, width = matte_alpha.shape
    seen = on_screen(
        flat,
        xy_from_world=xy_from_world,
        width=width,
        height=height,
        strand_bias_m=strand_bias_m,
        min_width_px=min_width_px,
    )
    pixel = seen.pixel
    solid = (matte_alpha > _SOLID).ravel()[pixel]
    alpha = np.where(solid, np.float32(1), flat.alpha)
    soft = np.flatnonzero(~(solid | covered.ravel()[pixel] | on_skin))
    soft = soft[~_behind_meshes(seen, soft, pixel[soft])]
    wanted = matte_alpha.ravel()[pixel[soft]]
    alpha[soft] = 1 - (1 - np.minimum(wanted, _SOLID)) ** (1 / _LAYERS)
    edge = _near_soft(matte_alpha, pixel)
    for _ in range(rounds):
        coverage = hair_coverage(seen.with_alpha(alpha).of_points(edge).rasterised())
        factor = _factor(matte_alpha, coverage).ravel()[pixel[soft]]
        alpha[soft] = 1 - (1 - np.minimum(alpha[soft], 0.999)) ** factor
    return seen.with_alpha(alpha).rasterised()


def _factor(wanted: NDArray[np.float32], coverage: NDArray[np.float32]) -> NDArray[np.floating]:
    """(H, W): by how much the optical depth of a pixel's strands should change."""
    target = -np.log1p(-np.clip(wanted, 0, _SOLID))
    present = -np.log1p(-np.where(wanted > _SOLID, _MOST_SEEN, np.clip(coverage, 0, _MOST_SEEN)))
    smooth_target, smooth_present = (cv2.GaussianBlur(depth, (0, 0), _BLUR_PX) + _FLOOR for depth in (target, present))
    return np.clip(smooth_target / smooth_present, 1 / _LARGEST_FACTOR, _LARGEST_FACTOR).astype(np.float32)


def _behind_meshes(seen: SceneOnScreen, points: NDArray[np.intp], pixel: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Which of the `points` (indices), which lie in `pixel`, have a mesh before them."""
    fragments = seen.of_points(np.zeros(len(seen.points), np.bool_)).rasterised().fragments
    first, end = fragments.pixel_offsets[:-1], fragments.pixel_offsets[1:]
    nearest = np.full(len(first), np.inf, np.float32)
    nearest[first < end] = fragments.depth[first[first < end]]
    return seen.points[points, 2] > nearest[pixel]


def _near_soft(matte_alpha: NDArray[np.float32], pixel: NDArray[np.integer]) -> NDArray[np.bool_]:
    """(N,): both ends of every segment of which an end lies in or near a soft pixel."""
    soft = ((matte_alpha > 0) & (matte_alpha <= _SOLID)).astype(np.uint8)
    near = cv2.dilate(soft, np.ones((2 * _NEAR_PX + 1,) * 2, np.uint8)).ravel()[pixel] > 0
    ends = near.copy()
    ends[1:] |= near[:-1]
    ends[:-1] |= near[1:]
    return ends
