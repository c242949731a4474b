"""Fields on pixels and voxels: distances, diffusion, depth of strands, streamlines. All run on every core, same bits
always.

A box of voxels is an array (layers, rows, columns): layer 0 is farthest from the camera, row 0 is the top, column 0
the left. Every function raises `InputError` for wrong shapes and numbers that are not finite.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked

Array = np.ndarray[Any, Any]


def distance(inside: Any) -> Array:
    """(L, R, C) float32: distance, in voxels, from each voxel's centre to that of the nearest voxel where `inside`
    is true.

    Exact; infinite where nothing is marked. Felzenszwalb and Huttenlocher 2012.

    >>> distance([[[True, False, False]]]).tolist()
    [[[0.0, 1.0, 2.0]]]
    """
    marks = checked(inside, name="inside", dtype=np.bool_, shape=(None, None, None))
    return _core.fields_distance(marks).reshape(marks.shape)


@dataclass(frozen=True)
class Nearest:
    """(L, R, C) each: `distance` float32 in voxels to the nearest marked voxel, and `cell` uint32, its number in the
    flattened box.
    """

    distance: Array
    cell: Array


def nearest(inside: Any) -> Nearest:
    """Of every voxel, the nearest where `inside` (L, R, C) is true; infinitely far, and itself, where none is marked.

    >>> nearest([[[True, False, False, False, True]]]).cell.tolist()
    [[[0, 0, 4, 4, 4]]]
    """
    marks = checked(inside, name="inside", dtype=np.bool_, shape=(None, None, None))
    far, cell = _core.fields_nearest(marks)
    return Nearest(far.reshape(marks.shape), cell.reshape(marks.shape))


def sample(values: Any, *, places: Any) -> Array:
    """(N,) float32: `values` (L, R, C) float32 at `places` (N, 3): column, row, layer, a voxel's centre at + 0.5.

    Trilinear; outside, the border's.

    >>> sample(np.float32([[[1, 3]]]), places=[[1.0, 0.5, 0.5]]).tolist()
    [2.0]
    """
    box = checked(values, name="values", dtype=np.float32, shape=(None, None, None))
    try:
        return _core.fields_sample(box, checked(places, name="places", dtype=np.float64, shape=(None, 3)))
    except ValueError as error:
        raise InputError(str(error)) from error


@dataclass(frozen=True)
class Diffused:
    """`values` as given to `diffuse`, float64, 0 outside the mask; the solver's steps and whether it converged."""

    values: Array
    iterations: int
    converged: bool


def diffuse(
    values: Any, *, mask: Any, weights: Any, fixed: Any = None, accuracy: float = 1e-5, max_iterations: int = 2000
) -> Diffused:
    """The smoothest values over `mask` that stay near `values` where `weights` says so, channel by channel.

    `values` (R, C), (L, R, C) or (L, R, C, K); `mask`, `weights` and `fixed` the same without K. Minimises
    `Σ weights (u - values)² + Σ over neighbours (u_i - u_j)²` with natural borders; where `fixed`, u = values. Weight 0
    everywhere and nothing fixed gives 0. `accuracy` is the residual relative to the right-hand side. Some 100 steps;
    cost linear in cells and steps.

    >>> ends = np.array([[True, False, False, False, True]])
    >>> field = diffuse(np.array([[0.0, 9, 9, 9, 4]]), mask=ends | True, weights=ends * 0.0, fixed=ends)
    >>> field.values.round(3).tolist()
    [[0.0, 1.0, 2.0, 3.0, 4.0]]
    """
    given = np.asarray(values, dtype=np.float64)
    marks = np.asarray(mask, dtype=np.bool_)
    channels = given.shape[marks.ndim :] or (1,)
    box = (1,) * (3 - marks.ndim) + marks.shape
    held = np.zeros(marks.shape, np.bool_) if fixed is None else np.asarray(fixed, dtype=np.bool_)
    amounts = checked(weights, name="weights", dtype=np.float64, shape=marks.shape)
    if held.shape != marks.shape or given.shape[: marks.ndim] != marks.shape or given.ndim > marks.ndim + 1:
        raise InputError(f"values {given.shape}, mask {marks.shape} and fixed {held.shape} do not fit each other.")
    if amounts.size and amounts.min() < 0:
        raise InputError(f"weights holds {amounts.min()}; numbers >= 0 were expected.")
    flat, iterations, converged = _core.fields_diffuse(
        np.ascontiguousarray(marks.reshape(box)),
        np.ascontiguousarray(np.where(held, np.inf, amounts).reshape(box)),
        checked(given.reshape(*box, *channels), name="values", dtype=np.float64, shape=(*box, *channels)),
        float(accuracy),
        int(max_iterations),
    )
    return Diffused(flat.reshape(given.shape), iterations, converged)


@dataclass(frozen=True)
class DiffusedAxes:
    """`axes` (N, 3) float64 unit, one a marked voxel in their order, zero where nothing reaches; the solver's steps
    and whether it converged.
    """

    axes: Array
    iterations: int
    converged: bool


def diffuse_axes(
    vectors: Any, *, mask: Any, weights: Any, accuracy: float = 5e-3, max_iterations: int = 200
) -> DiffusedAxes:
    """Directions over the N voxels of `mask` (L, R, C), from unit `vectors` (N, 3) that `weights` (N,) >= 0 hold.

    Diffused as structure tensors (Chai et al. 2012, section 3.3.2), which know no forth and back, with their sense.

    >>> ends = np.array([[0, -1, 0], [0, 0, 0], [0, -1, 0]])
    >>> (diffuse_axes(ends, mask=np.ones((1, 1, 3), bool), weights=[1, 0, 1]).axes[1].round(3) + 0.0).tolist()
    [0.0, -1.0, 0.0]
    """
    marks = checked(mask, name="mask", dtype=np.bool_, shape=(None, None, None))
    count = int(marks.sum())
    try:
        axes, iterations, converged = _core.fields_diffuse_axes(
            marks,
            checked(vectors, name="vectors", dtype=np.float64, shape=(count, 3)),
            checked(weights, name="weights", dtype=np.float64, shape=(count,)),
            float(accuracy),
            int(max_iterations),
        )
    except ValueError as error:
        raise InputError(str(error)) from error
    return DiffusedAxes(axes, iterations, converged)


@dataclass(frozen=True)
class MeshDepth:
    """(R, C) float64 each: largest (`front`) and smallest (`back`) z of a mesh under a cell's centre; NaN beside it."""

    front: Array
    back: Array


def mesh_depth(vertices: Any, triangles: Any, *, shape: tuple[int, int]) -> MeshDepth:
    """Depths of a mesh on a picture of `shape` cells; `vertices` (V, 3) holds x and y in cells (centres at + 0.5)
    and z.

    >>> depth = mesh_depth([[0, 0, 5], [9, 0, 5], [0, 9, 5]], [[0, 1, 2]], shape=(1, 2))
    >>> depth.front.tolist()
    [[5.0, 5.0]]
    """
    points = checked(vertices, name="vertices", dtype=np.float64, shape=(None, 3))
    corners = checked(triangles, name="triangles", dtype=np.int32, shape=(None, 3))
    try:
        front, back = _core.fields_mesh_depth(points, corners, *shape)
    except ValueError as error:
        raise InputError(str(error)) from error
    return MeshDepth(front.reshape(shape), back.reshape(shape))


def principal_axes(tensors: Any, *, hints: Any) -> Array:
    """(N, 3) float64: unit axis of the largest eigenvalue of each tensor, on the side of its hint (N, 3).

    `tensors` (N, 6): xx, yy, zz, xy, xz, yz. Where no axis is largest, the normalised hint; zero where that is zero.

    >>> axis = principal_axes([[0, 4, 1, 0, 0, 0]], hints=[[0, -1, 0]])
    >>> bool(np.allclose(axis, [[0, -1, 0]]))
    True
    """
    rows = checked(tensors, name="tensors", dtype=np.float64, shape=(None, 6))
    return _core.fields_principal_axes(rows, checked(hints, name="hints", dtype=np.float64, shape=(len(rows), 3)))


@dataclass(frozen=True)
class Neighbours:
    """Vertex numbers alongside each vertex: those of vertex i are `members[starts[i]:starts[i + 1]]`, nearest first."""

    starts: Array
    members: Array


def neighbours(
    points: Any, *, offsets: Any, occluded: Any, radius: float, max_angle: float, most: int = 6
) -> Neighbours:
    """For each vertex (N, 2) the `most` nearest of *other* strands within `radius` that run within `max_angle`
    (radians) of its direction and have the same `occluded` flag: N(p) of Chai et al. 2012, section 3.3.1.
    """
    plane = checked(points, name="points", dtype=np.float64, shape=(None, 2))
    try:
        starts, members = _core.fields_neighbours(
            plane,
            checked(offsets, name="offsets", dtype=np.int64, shape=(None,)),
            checked(occluded, name="occluded", dtype=np.bool_, shape=(len(plane),)),
            float(radius),
            float(np.cos(max_angle)),
            int(most),
        )
    except ValueError as error:
        raise InputError(str(error)) from error
    return Neighbours(starts, members)


@dataclass(frozen=True)
class Depths:
    """`z` (N,) float64; the solver's steps, whether it converged and the residual relative to the right-hand side."""

    z: Array
    iterations: int
    converged: bool
    residual: float


def strand_depths(
    target: Any,
    *,
    weight: Any,
    offsets: Any,
    near: Neighbours,
    start: Any,
    strand_weight: float = 2.0,
    neighbour_weight: float = 1.0,
    accuracy: float = 1e-6,
    max_iterations: int = 500,
) -> Depths:
    """Depth of every vertex by the energy of Chai et al. 2012, eq. 5.

    `target` (N,) holds where `weight` (N,) > 0 (w_Z z̄); `start` (N,) is where the iteration begins. Conjugate
    gradients with every strand's own band inverted exactly.

    >>> lists = Neighbours(np.zeros(4, np.int64), np.zeros(0, np.uint32))
    >>> found = strand_depths([0, 0, 2], weight=[5, 0, 5], offsets=[0, 3], near=lists, start=[0, 0, 0])
    >>> bool(np.allclose(found.z, [0, 1, 2]))
    True
    """
    goal = checked(target, name="target", dtype=np.float64, shape=(None,))
    count = (len(goal),)
    try:
        z, iterations, converged, residual = _core.fields_strand_depths(
            checked(offsets, name="offsets", dtype=np.int64, shape=(None,)),
            checked(near.starts, name="near.starts", dtype=np.int64, shape=(len(goal) + 1,)),
            checked(near.members, name="near.members", dtype=np.uint32, shape=(None,)),
            goal,
            checked(weight, name="weight", dtype=np.float64, shape=count),
            checked(start, name="start", dtype=np.float64, shape=count),
            (float(strand_weight), float(neighbour_weight), float(accuracy), int(max_iterations)),
        )
    except ValueError as error:
        raise InputError(str(error)) from error
    return Depths(z, iterations, converged, residual)


@dataclass(frozen=True)
class VoxelField:
    """Directions in a box of voxels: voxel (l, r, c) has its centre at `origin + size (c + ½, -(r + ½), l + ½)`,
    metres.

    `direction` (L, R, C, 3) float32, unit, root to tip, zero outside the hair; `head_distance` (L, R, C) float32,
    metres, negative inside the head.
    """

    direction: Array
    head_distance: Array
    origin: Array
    size: float


@dataclass(frozen=True)
class FrontSheet:
    """The visible surface of the hair on the photograph's pixels.

    `depth` (H, W) float32 metres, NaN beside the hair; `direction` (H, W, 2) float32 root to tip, y down, zero where
    unknown; `xy_from_view` (3, 4): u = s x + cx, v = -s y + cy.
    """

    depth: Array
    direction: Array
    xy_from_view: Array


@dataclass(frozen=True)
class TraceSettings:
    """How `trace` walks; lengths in metres, `min_cosine` between two steps, `inertia` in [0, 1).

    A strand ends where a voxel has `voxel_cap` strands, or (if `pixel_cap` > 0) a pixel of the sheet `pixel_cap`;
    seeds in pixels that have a strand are then skipped.
    """

    step: float
    min_length: float
    sheet_depth: float
    min_cosine: float
    inertia: float
    voxel_cap: int
    pixel_cap: int
    clearance: float
    most: int


@dataclass(frozen=True)
class Traced:
    """`points` (N, 3) float64, `offsets` (S + 1,) int64, root to tip; `seed` (S,) the row of the seed; `rooted`
    (S,): the root meets the head; `density` (L, R, C) uint16: strands in each voxel so far.
    """

    points: Array
    offsets: Array
    seed: Array
    rooted: Array
    density: Array


def trace(
    seeds: Any, *, field: VoxelField, sheet: FrontSheet, settings: TraceSettings, density: Array | None = None
) -> Traced:
    """Streamlines both ways from `seeds` (N, 5): x, y, z, longest way to the tip, longest way to the root, metres.

    Within `sheet_depth` of the sheet the picture steers and the strand keeps its depth behind it; elsewhere the
    voxels do.
    """
    box = np.shape(field.head_distance)
    rows, columns = np.shape(sheet.depth)
    seen = np.isfinite(sheet.depth)
    scene = _Scene(
        checked(field.direction, name="direction", dtype=np.float32, shape=(*box, 3)),
        checked(field.head_distance, name="head_distance", dtype=np.float32, shape=(None, None, None)),
        [float(v) for v in field.origin],
        float(field.size),
        np.ascontiguousarray(np.where(seen, sheet.depth, np.nan), dtype=np.float32),
        checked(sheet.direction, name="sheet.direction", dtype=np.float32, shape=(rows, columns, 2)),
        float(sheet.xy_from_view[0, 0]),
        [float(sheet.xy_from_view[0, 3]), float(sheet.xy_from_view[1, 3])],
    )
    before = np.zeros(box, np.uint16) if density is None else density
    starts = checked(seeds, name="seeds", dtype=np.float64, shape=(None, 5))
    points, offsets, seed, rooted, after = _core.fields_trace(
        scene, starts, checked(before, name="density", dtype=np.uint16, shape=box).ravel(), settings
    )
    return Traced(points, offsets, seed, rooted, after.reshape(box))


@dataclass(frozen=True)
class _Scene:
    direction: Array
    head_distance: Array
    origin: list[float]
    size: float
    sheet_depth: Array
    sheet_direction: Array
    scale: float
    centre: list[float]
