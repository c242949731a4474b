"""Depth relief: locks that lie before others stand out, gaps between them are dark."""

from typing import Any

import numpy as np
from scipy.ndimage import gaussian_filter

from tress.kernel import raster
from tress.render.gbuffer import GBuffer, HairFragments

Array = np.ndarray[Any, Any]


def depth_relief(gbuffer: GBuffer, hair: HairFragments, *, reach_m: float = 0.006, depth_m: float = 0.004) -> Array:
    """(K,) float32 from -1 to 1: how far hair lies before (+) or behind (-) the smoothed surface of the hair around it.

    `reach_m` is the radius of the smoothing on the screen, `depth_m` the distance from the surface that counts as half.
    Unsharp masking of the depth buffer (Luft et al. 2006), within hair only.
    """
    away = (gbuffer.scene.points @ gbuffer.away).astype(np.float32)
    depth = hair.values(away)
    if len(depth) == 0:
        return depth
    rgba = np.zeros((len(gbuffer.fragments.weight), 4), np.float32)
    middle = np.float32(np.median(depth))
    rgba[hair.index, 0] = depth - middle
    rgba[hair.index, 3] = 1
    summed = raster.composite(gbuffer.fragments, rgba=rgba)
    sigma = max(reach_m * _pixels_per_metre(gbuffer), 0.5)
    weight = gaussian_filter(summed[..., 3], sigma)
    surface = gaussian_filter(summed[..., 0], sigma) / np.maximum(weight, 1e-6) + middle
    behind = depth - surface.reshape(-1)[gbuffer.fragments.pixel[hair.index]]
    return (-behind / (np.abs(behind) + depth_m)).astype(np.float32)


def _pixels_per_metre(gbuffer: GBuffer) -> float:
    centre = gbuffer.scene.points[:: max(len(gbuffer.scene.points) // 64, 1)].mean(axis=0, keepdims=True)
    return float(raster.project(centre, xy_from_points=gbuffer.xy_from_world)[0, 3])
