"""Opacity of the strands with which they cover each pixel of the photo as much as the matte says.

Several strands lie behind each other, and what shines through all of them is the product of what shines through each:
their optical depths, `-log(1 - alpha)`, add up. So the depth that a pixel lacks or has too much is handed to every
strand there as a factor. Without this, soft edges come out solid, and would have to take on the background's colour to
look like the photo.

Limits: strands are seen through 16 samples a pixel, so that more than 97 % coverage cannot be told from all of it; a
pixel that no strand crosses stays empty.
"""

from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.kernel import raster
from tress.kernel.geom import rays_blocked
from tress.render.flat_scene import FlatScene
from tress.render.gbuffer import GBuffer, hair_coverage, rasterise

_SOLID = 0.98
"""Matte from which hair counts as solid."""
_MOST_SEEN = 0.97
"""Coverage above which all samples may be taken."""
_LAYERS = 4.0
"""Strands that lie behind each other at a soft edge, to begin with."""
_BLUR_PX = 1.5
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
    side where it fills the outline. Costs `rounds + 1` rasterisations.
    """
    pixel = _pixels(flat, matte_alpha.shape, xy_from_world)
    wanted = matte_alpha.ravel()[pixel]
    solid = wanted > _SOLID
    kept = solid | covered.ravel()[pixel] | on_skin
    kept[~kept] = _behind_head(flat, np.flatnonzero(~kept), xy_from_world)
    own = np.where(solid, 1.0, flat.alpha)
    alpha = np.where(kept, own, 1 - (1 - np.minimum(wanted, _SOLID)) ** (1 / _LAYERS))

    def seen() -> GBuffer:
        height, width = matte_alpha.shape
        return rasterise(
            replace(flat, alpha=alpha.astype(np.float32)),
            xy_from_world=xy_from_world,
            width=width,
            height=height,
            strand_bias_m=strand_bias_m,
            min_width_px=min_width_px,
        )

    gbuffer = seen()
    for _ in range(rounds):
        factor = _factor(matte_alpha, hair_coverage(gbuffer)).ravel()[pixel]
        alpha = np.where(kept, own, 1 - (1 - np.minimum(alpha, 0.999)) ** factor)
        gbuffer = seen()
    return gbuffer


def _factor(wanted: NDArray[np.float32], coverage: NDArray[np.float32]) -> NDArray[np.floating]:
    """(H, W): by how much the optical depth of a pixel's strands should change."""
    target = -np.log1p(-np.clip(wanted, 0, _SOLID))
    present = -np.log1p(-np.clip(coverage, 0, _MOST_SEEN))
    smooth_target, smooth_present = (cv2.GaussianBlur(depth, (0, 0), _BLUR_PX) + _FLOOR for depth in (target, present))
    return np.clip(smooth_target / smooth_present, 1 / _LARGEST_FACTOR, _LARGEST_FACTOR).astype(np.float32)


def _behind_head(flat: FlatScene, points: NDArray[np.intp], xy_from_world: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which of the `points` (indices) have a mesh between them and the camera."""
    towards = np.cross(xy_from_world[1, :3], xy_from_world[0, :3])
    directions = np.broadcast_to(towards / np.linalg.norm(towards), (len(points), 3))
    blocked = rays_blocked(flat.positions, triangles=flat.triangles, origins=flat.points[points], directions=directions)
    return np.asarray(blocked, np.bool_)


def _pixels(flat: FlatScene, shape: tuple[int, ...], xy_from_world: NDArray[np.float64]) -> NDArray[np.intp]:
    """Index (N,) of the pixel, row by row, in which every point lies; points beside the photo take its border."""
    xy = raster.project(flat.points, xy_from_points=xy_from_world)[:, :2]
    column, row = (np.clip(xy[:, axis].astype(np.intp), 0, shape[1 - axis] - 1) for axis in (0, 1))
    return row * shape[1] + column
