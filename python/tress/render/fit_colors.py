"""Analysis by synthesis: colours of the strands with which the picture comes out as it should.

The picture is linear in the colours of the points: each pixel is a mean of colours, weighted by what it sees. The
transpose hands errors back to the points. SIRT (simultaneous iterative reconstruction) divides both ways by the sums of
the weights, which makes every step a mean of errors and safe without a step size; Nesterov's momentum makes it fast.
Few iterations are enough, and stopping early keeps neighbouring points alike, since only errors are handed back, in the
shares of shading.
"""

from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.kernel import raster
from tress.render.gbuffer import GBuffer, HairFragments, hair_coverage, hair_fragments

Array = np.ndarray[Any, Any]


def fit_vertex_colors(
    gbuffer: GBuffer,
    *,
    colors: Array,
    target_linear: Array,
    weight: Array,
    iterations: int = 12,
    most: float = 1.5,
) -> Array:
    """Colours (N, 3) float32 in [0, `most`] of the points, with which the hair in the picture has the target's colours.

    `colors` (N, 3) is where to start, and what points keep that do not show. `target_linear` (H, W, 3) is the colour of
    the hair alone in every pixel, linear, not premultiplied: the matte's foreground. `weight` (H, W), not negative,
    says how much each pixel counts; 0 where the target says nothing. Cost: linear in fragments, per iteration.

    Raises `InputError` for shapes that do not fit the GBuffer.
    """
    _check(gbuffer, colors, target_linear, weight)
    hair = hair_fragments(gbuffer)
    coverage = hair_coverage(gbuffer)
    counts = np.where(coverage > 0, weight, 0).astype(np.float32)
    found = ahead = np.clip(np.asarray(colors, np.float32), 0, most)
    pace = 1.0
    for _ in range(iterations):
        shown = _shown(gbuffer, hair, ahead) / np.maximum(coverage, 1e-6)[..., None]
        residual = np.where(counts[..., None] > 0, target_linear - shown, 0)
        step, _ = raster.splat_residual(gbuffer.fragments, residual=residual, pixel_weight=counts, points=len(found))
        previous, found = found, np.clip(ahead + step, 0, most)
        next_pace = 0.5 * (1 + np.sqrt(1 + 4 * pace * pace))
        ahead = np.clip(found + np.float32((pace - 1) / next_pace) * (found - previous), 0, most)
        pace = next_pace
    return found


def _shown(gbuffer: GBuffer, hair: HairFragments, colors: Array) -> Array:
    """(H, W, 3): the hair's colours times its coverage."""
    rgba = np.zeros((len(gbuffer.fragments.weight), 4), np.float32)
    rgba[hair.index, :3] = hair.values(colors)
    rgba[hair.index, 3] = 1
    return raster.composite(gbuffer.fragments, rgba=rgba)[..., :3]


def _check(gbuffer: GBuffer, colors: Array, target: Array, weight: Array) -> None:
    points, size = len(gbuffer.scene.points), gbuffer.shape
    for name, array, expected in (
        ("colors", colors, (points, 3)),
        ("target_linear", target, (*size, 3)),
        ("weight", weight, size),
    ):
        if np.shape(array) != expected:
            raise InputError(f"{name} has shape {np.shape(array)}; {expected} was expected.")
