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
from tress.render.gbuffer import GBuffer

Array = np.ndarray[Any, Any]


def fit_vertex_colors(
    gbuffer: GBuffer,
    *,
    colors: Array,
    target_linear: Array,
    weight: Array,
    freedom: Array | None = None,
    iterations: int = 12,
    most: float = 1.5,
) -> Array:
    """Colours (N, 3) float32 in [0, `most`] of the points, with which the hair in the picture has the target's colours.

    `colors` (N, 3) is where to start, and what points keep that do not show. `target_linear` (H, W, 3) is the colour of
    the hair alone in every pixel, linear, not premultiplied: the matte's foreground. `weight` (H, W), not negative,
    says how much each pixel counts; 0 where the target says nothing. `freedom` (N,) in [0, 1] says how readily each
    point leaves the colour it starts from; all do without it. Cost: linear in fragments, per iteration.

    Raises `InputError` for shapes that do not fit the GBuffer.
    """
    free = np.ones(len(gbuffer.scene.points), np.float32) if freedom is None else freedom
    _check(gbuffer, colors, target_linear, weight, free)
    return raster.fit_colors(
        gbuffer.fragments,
        colors=colors,
        freedom=free,
        target=np.where(np.asarray(weight)[..., None] > 0, target_linear, 0),
        pixel_weight=weight,
        iterations=iterations,
        most=most,
    )


def _check(gbuffer: GBuffer, colors: Array, target: Array, weight: Array, freedom: Array) -> None:
    points, size = len(gbuffer.scene.points), gbuffer.shape
    for name, array, expected in (
        ("colors", colors, (points, 3)),
        ("target_linear", target, (*size, 3)),
        ("weight", weight, size),
        ("freedom", freedom, (points,)),
    ):
        if np.shape(array) != expected:
            raise InputError(f"{name} has shape {np.shape(array)}; {expected} was expected.")
