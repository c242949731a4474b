"""Visibility of strands and triangles on the screen: projection, fragments a pixel, and the transpose of shading.

A projected vertex is (x, y, depth, scale), float32: pixels (first pixel centre at 0.5, y down); a depth that grows away
from the viewer and is linear on the screen (metres for an affine camera, -1 / distance for a perspective one); pixels a
metre (0 behind a perspective camera: what hangs on such a vertex is not drawn). Baking passes uv coordinates times the
size of the texture, a depth of 0 and a scale of 1.

Every function raises `InputError` for wrong shapes and numbers that are not finite, and gives the same bits on any
number of cores.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked

Array = np.ndarray[Any, Any]

SEGMENT = 0
TRIANGLE = 1


@dataclass(frozen=True, eq=False)
class Fragments:
    """What every pixel sees: fragments `pixel_offsets[p]:pixel_offsets[p + 1]` of pixel p (row by row), front to back.

    - `pixel_offsets` (H * W + 1,) int64
    - `kind` (F,) uint8: `SEGMENT` or `TRIANGLE`
    - `primitive` (F,) int32: first point of the segment, or index of the triangle
    - `parameter` (F, 2) float32: along the segment 0 to 1 and across the strand -1 to 1 (to the right of its direction,
      with y down), or the barycentric coordinates of the triangle's second and third corner; right in perspective
    - `weight` (F,) float32: share of the pixel, a multiple of 1/16 where nothing is seen through; the sum over a pixel
      is its coverage
    - `depth` (F,) float32: as given with the vertices
    """

    width: int
    height: int
    pixel_offsets: Array
    kind: Array
    primitive: Array
    parameter: Array
    weight: Array
    depth: Array

    @property
    def pixel(self) -> Array:
        """(F,) int64: the pixel of every fragment, row * width + column."""
        return np.repeat(np.arange(self.width * self.height), np.diff(self.pixel_offsets))


@dataclass(frozen=True, eq=False)
class Cutouts:
    """Opacity over triangles: `pictures` (H, W) uint8, 255 opaque, the top row first; `of_triangle` (F,) int32, the
    picture of every triangle or -1 for an opaque one; `corner_uv` (F, 3, 2) float32, v up."""

    pictures: Sequence[Array] = ()
    of_triangle: Array = field(default_factory=lambda: np.zeros(0, np.int32))
    corner_uv: Array = field(default_factory=lambda: np.zeros((0, 3, 2), np.float32))


OPAQUE = Cutouts()


def project(points: Array, *, xy_from_points: Array) -> Array:
    """Projected vertices (N, 4) float32 of `points` (N, 3) by the matrix (3, 4), [u w, v w, w] = M [x, y, z, 1].

    >>> project([[0, 0.125, 2]], xy_from_points=[[500, 0, 0, 50], [0, -500, 0, 60], [0, 0, 0, 1]]).tolist()
    [[50.0, -2.5, -2.0, 500.0]]
    """
    matrix = checked(xy_from_points, name="xy_from_points", dtype=np.float64, shape=(3, 4))
    try:
        return _core.raster_project(checked(points, name="points", dtype=np.float32, shape=(None, 3)), matrix)
    except ValueError as error:
        raise InputError(f"The camera does not fit the scene: {error}.") from error


def rasterise(
    strand_points: Array,
    *,
    offsets: Array,
    half_width_px: Array,
    alpha: Array,
    mesh_vertices: Array,
    triangles: Array,
    width: int,
    height: int,
    cutouts: Cutouts = OPAQUE,
    min_width_px: float = 1.0,
) -> Fragments:
    """What every pixel of a picture sees of projected strands (N, 4) and triangles (F, 3) of projected vertices (V, 4).

    16 samples a pixel, each with its own depth test; triangles are seen from both sides, and through where `cutouts`
    say so: every sample orders its layers by depth and adds them up exactly, also where triangles pass through each
    other; what is left of less than 1/512 goes to the layer before it. Strand i is
    `strand_points[offsets[i]:offsets[i + 1]]`, with `half_width_px` (N,) and `alpha` (N,) at its points. Strands
    narrower than `min_width_px` are drawn that wide with as much less opacity. Opacity is a random subset of the
    samples, the same along a strand and independent between strands; it is right in the mean, with steps of 1/16.

    Cost: 2.5 million segments to 1000 x 1000 pixels in 0.4 to 1 s of one core, thin and transparent strands the most.
    Limits: a strand that points exactly at the viewer shows nothing; pictures of at most 16384 pixels a side; opacity
    is read bilinearly at every sample: textures more than four times as fine as the picture are undersampled.
    """
    given = (
        checked(strand_points, name="strand_points", dtype=np.float32, shape=(None, 4)),
        checked(offsets, name="offsets", dtype=np.int64, shape=(None,)),
        checked(half_width_px, name="half_width_px", dtype=np.float32, shape=(None,)),
        checked(alpha, name="alpha", dtype=np.float32, shape=(None,)),
        checked(mesh_vertices, name="mesh_vertices", dtype=np.float32, shape=(None, 4)),
        checked(triangles, name="triangles", dtype=np.uint32, shape=(None, 3)),
        [checked(picture, name="cutouts", dtype=np.uint8, shape=(None, None)) for picture in cutouts.pictures],
        checked(cutouts.of_triangle, name="cutouts.of_triangle", dtype=np.int32, shape=(None,)),
        checked(cutouts.corner_uv, name="cutouts.corner_uv", dtype=np.float32, shape=(None, 3, 2)).reshape(-1, 6),
    )
    if width < 1 or height < 1:
        raise InputError(f"The picture is {width} x {height} pixels; positive numbers were expected.")
    try:
        arrays = _core.raster_gbuffer(*given, float(min_width_px), int(width), int(height))
    except ValueError as error:
        raise InputError(f"The scene cannot be drawn: {error}.") from error
    return Fragments(width=width, height=height, **arrays)


def composite(fragments: Fragments, *, rgba: Array) -> Array:
    """Premultiplied RGBA (H, W, 4) float32: the sum over a pixel of weight times `rgba` (F, 4), straight, linear."""
    shaded = checked(rgba, name="rgba", dtype=np.float32, shape=(len(fragments.weight), 4))
    picture = _core.raster_composite(fragments.pixel_offsets, fragments.weight, shaded)
    return picture.reshape(fragments.height, fragments.width, 4)


def interpolated(values: Array, *, first: Array, t: Array) -> Array:
    """(K, ...) float32: `values` (N, ...) of the points at the places `t` (K,) from point `first` (K,) to the next.

    >>> interpolated(np.array([0.0, 2.0, 3.0]), first=[0, 1], t=[0.5, 1.0]).tolist()
    [1.0, 3.0]
    """
    given = np.asarray(values)
    if given.size == 0 or np.size(first) == 0:
        return np.zeros((np.size(first), *given.shape[1:]), np.float32)
    rows = checked(given.reshape(len(given), -1), name="values", dtype=np.float32, shape=(None, None))
    begin = checked(first, name="first", dtype=np.int32, shape=(None,))
    place = checked(t, name="t", dtype=np.float32, shape=(len(begin),))
    if begin.min() < 0 or begin.max() + 1 >= len(rows):
        raise InputError(f"first runs from {begin.min()} to {begin.max()}; 0 to {len(rows) - 2} was expected.")
    return _core.raster_interpolated(begin, place, rows).reshape(len(begin), *given.shape[1:])


def strand_picture(fragments: Fragments, *, colors: Array) -> Array:
    """Premultiplied RGBA (H, W, 4) float32 of the strands alone, in the `colors` (N, 3) of their points, linear."""
    values = checked(colors, name="colors", dtype=np.float32, shape=(None, 3))
    _check_points(fragments, len(values))
    picture = _core.raster_strand_picture(*_segment_arrays(fragments), values)
    return picture.reshape(fragments.height, fragments.width, 4)


def visible_weight(fragments: Fragments, *, points: int) -> Array:
    """(points,) float32: how many pixels every strand point fills, sharing each fragment as 1 - t and t."""
    _check_points(fragments, points)
    return _core.raster_visible_weight(*_segment_arrays(fragments), points)


def fit_colors(
    fragments: Fragments,
    *,
    colors: Array,
    freedom: Array,
    target: Array,
    pixel_weight: Array,
    iterations: int,
    most: float,
) -> Array:
    """Colours (N, 3) float32 in [0, `most`] of the strand points, from `colors` (N, 3) on, nearing `target` (H, W, 3).

    SIRT with momentum: the mean colour of the hair in every pixel is compared with the target, and errors are handed
    back to the points in the shares of their fragments, 1 - t and t. A point moves by the share `freedom` (N,), in
    [0, 1], of its error. `pixel_weight` (H, W): how much a pixel counts; 0 for not at all.
    """
    start = checked(colors, name="colors", dtype=np.float32, shape=(None, 3))
    _check_points(fragments, len(start))
    size = (fragments.height, fragments.width)
    values = checked(target, name="target", dtype=np.float32, shape=(*size, 3)).reshape(-1, 3)
    factor = checked(pixel_weight, name="pixel_weight", dtype=np.float32, shape=size).reshape(-1)
    free = checked(freedom, name="freedom", dtype=np.float32, shape=(len(start),))
    settings = (int(iterations), float(most))
    return _core.raster_fit_colors(*_segment_arrays(fragments), start, free, values, factor, *settings)


def _segment_arrays(fragments: Fragments) -> tuple[Array, ...]:
    return fragments.pixel_offsets, fragments.kind, fragments.primitive, fragments.parameter, fragments.weight


def _check_points(fragments: Fragments, points: int) -> None:
    first = fragments.primitive[fragments.kind == SEGMENT]
    if first.size and first.max() + 1 >= points:
        raise InputError(f"points is {points}; more than {first.max() + 1} was expected, as the fragments name.")
