"""Fields: closed forms, SciPy as second implementation, laws."""

import itertools

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt, map_coordinates
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import spsolve

from tress.base.errors import InputError
from tress.kernel import fields


def disc(size: int) -> np.ndarray:
    y, x = np.mgrid[:size, :size] + 0.5 - size / 2
    return np.hypot(x, y)


def test_distance_agrees_with_scipy():
    marks = np.random.default_rng(1).random((9, 17, 13)) > 0.97
    assert np.allclose(fields.distance(marks), distance_transform_edt(~marks), atol=1e-5)


def test_the_nearest_voxel_is_as_far_as_scipy_says():
    marks = np.random.default_rng(2).random((8, 12, 15)) > 0.98
    found = fields.nearest(marks)
    assert marks.ravel()[found.cell].all()
    gap = np.stack(np.indices(marks.shape)) - np.stack(np.unravel_index(found.cell, marks.shape))
    assert np.allclose(np.linalg.norm(gap, axis=0), distance_transform_edt(~marks), atol=1e-5)


def test_samples_agree_with_scipy():
    random = np.random.default_rng(3)
    values = random.normal(size=(6, 7, 8)).astype(np.float32)
    places = random.uniform(-1, 9, (300, 3))
    expected = map_coordinates(values, places[:, ::-1].T - 0.5, order=1, mode="nearest")
    assert np.allclose(fields.sample(values, places=places), expected, atol=1e-5)


def test_diffused_axes_agree_with_tensors_diffused_one_by_one():
    random = np.random.default_rng(4)
    mask = random.random((5, 6, 7)) > 0.2
    vectors = random.normal(size=(int(mask.sum()), 3))
    vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    weights = random.uniform(0, 2, len(vectors))
    found = fields.diffuse_axes(vectors, mask=mask, weights=weights, accuracy=1e-10, max_iterations=1000)
    x, y, z = vectors.T
    held = np.zeros(mask.shape)
    held[mask] = weights
    channels = []
    for channel in (x * x, y * y, z * z, x * y, x * z, y * z, x, y, z):
        given = np.zeros(mask.shape)
        given[mask] = channel
        channels.append(fields.diffuse(given, mask=mask, weights=held, accuracy=1e-10).values[mask])
    alone = np.stack(channels, axis=1)
    axes = fields.principal_axes(alone[:, :6], hints=alone[:, 6:])
    assert np.abs(np.abs((found.axes * axes).sum(axis=1)) - 1).max() < 1e-6


def test_harmonic_between_two_circles_is_the_logarithm():
    radius = disc(161)
    mask = (radius > 19.5) & (radius < 75.5)
    fixed = mask & ((radius < 20.5) | (radius > 74.5))
    exact = np.log(np.maximum(radius, 1) / 20) / np.log(75 / 20)
    found = fields.diffuse(
        np.where(fixed, exact, 0), mask=mask, weights=np.zeros(mask.shape), fixed=fixed, accuracy=1e-9
    )
    assert found.converged
    assert np.abs(found.values - exact)[mask].max() < 2e-3


def test_linear_values_on_the_border_of_a_rectangle_are_continued():
    y, x = np.mgrid[:70, :90]
    linear = 0.3 * x - 0.2 * y + 1.0
    border = (x == 0) | (x == 89) | (y == 0) | (y == 69)
    found = fields.diffuse(
        np.where(border, linear, 5.0), mask=border | True, weights=np.zeros(x.shape), fixed=border, accuracy=1e-11
    )
    assert np.abs(found.values - linear).max() < 1e-6


def test_diffusion_agrees_with_a_direct_solver():
    random = np.random.default_rng(3)
    shape = (7, 23, 19)
    mask = random.random(shape) > 0.2
    weights = np.where(random.random(shape) > 0.8, random.random(shape), 1e-3)
    values = random.normal(size=(*shape, 3))
    found = fields.diffuse(values, mask=mask, weights=weights, accuracy=1e-11)
    expected = direct(mask, weights, values)
    assert found.converged
    assert np.abs(found.values[mask] - expected).max() < 1e-7
    assert not found.values[~mask].any()


def direct(mask: np.ndarray, weights: np.ndarray, values: np.ndarray) -> np.ndarray:
    number = np.full(mask.shape, -1)
    number[mask] = np.arange(mask.sum())
    pairs = []
    for axis in range(3):
        here = np.moveaxis(number, axis, 0)[:-1].ravel()
        there = np.moveaxis(number, axis, 0)[1:].ravel()
        both = (here >= 0) & (there >= 0)
        pairs.append(np.stack([here[both], there[both]]))
    i, j = np.concatenate(pairs, axis=1)
    size = mask.sum()
    links = coo_array((np.ones(2 * len(i)), (np.r_[i, j], np.r_[j, i])), shape=(size, size)).tocsr()
    matrix = diags_array(links.sum(axis=1) + weights[mask]) - links
    return np.asarray(spsolve(matrix.tocsc(), weights[mask][:, None] * values[mask]))


def test_diffusion_keeps_within_its_data():
    random = np.random.default_rng(5)
    values = random.random((40, 50))
    found = fields.diffuse(values, mask=np.ones(values.shape, bool), weights=random.random(values.shape), accuracy=1e-9)
    assert values.min() <= found.values.min() <= found.values.max() <= values.max()


def test_negative_weights_are_refused():
    with pytest.raises(InputError):
        fields.diffuse(np.zeros((3, 3)), mask=np.ones((3, 3)), weights=-np.ones((3, 3)))


def random_strands(count: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    start, angle = random.uniform(0, 60, (count, 1, 2)), random.uniform(0.2, 0.6, (count, 1))
    along = np.arange(12) * 1.5
    points = start + np.stack([np.cos(angle) * along, np.sin(angle) * along], axis=-1)
    return points.reshape(-1, 2), np.arange(count + 1) * 12


def energy_matrices(near: fields.Neighbours, count: int, offsets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    bend, stray = np.zeros((count, count)), np.zeros((count, count))
    for first, end in itertools.pairwise(offsets):
        for i in range(first + 1, end - 1):
            bend[i, [i - 1, i, i + 1]] = [-0.5, 1, -0.5]
    for i in range(count):
        members = near.members[near.starts[i] : near.starts[i + 1]]
        if len(members):
            stray[i, i] = 1
            stray[i, members] -= 1 / len(members)
    return bend, stray


def test_depths_minimise_the_energy():
    points, offsets = random_strands(20)
    occluded = np.zeros(len(points), bool)
    near = fields.neighbours(points, offsets=offsets, occluded=occluded, radius=4, max_angle=0.3)
    random = np.random.default_rng(2)
    target, weight = random.normal(size=len(points)), 5.0 * (random.random(len(points)) > 0.7) + 0.01
    found = fields.strand_depths(
        target, weight=weight, offsets=offsets, near=near, start=np.zeros(len(points)), accuracy=1e-11
    )
    bend, stray = energy_matrices(near, len(points), offsets)
    matrix = np.diag(weight) + 2 * bend.T @ bend + stray.T @ stray
    assert found.converged
    assert np.abs(found.z - np.linalg.solve(matrix, weight * target)).max() < 1e-7


def test_depths_move_with_their_targets():
    points, offsets = random_strands(15, seed=4)
    near = fields.neighbours(points, offsets=offsets, occluded=np.zeros(len(points), bool), radius=5, max_angle=0.3)
    random = np.random.default_rng(6)
    target, weight = random.normal(size=len(points)), random.random(len(points))

    def solve(goal):
        return fields.strand_depths(
            goal, weight=weight, offsets=offsets, near=near, start=np.zeros(len(points)), accuracy=1e-11
        ).z

    assert np.allclose(solve(target + 0.7), solve(target) + 0.7, atol=1e-7)
    assert np.allclose(solve(3 * target), 3 * solve(target), atol=1e-7)


def test_neighbours_share_the_occlusion_flag():
    points, offsets = random_strands(40)
    occluded = np.random.default_rng(0).random(len(points)) > 0.5
    near = fields.neighbours(points, offsets=offsets, occluded=occluded, radius=6, max_angle=0.5)
    vertex = np.repeat(np.arange(len(points)), np.diff(near.starts))
    assert len(near.members) > 100
    assert (occluded[vertex] == occluded[near.members]).all()
    assert (vertex // 12 != near.members // 12).all()


def test_principal_axes_agree_with_numpy():
    a = np.random.default_rng(0).normal(size=(200, 3, 3))
    tensors = a @ a.transpose(0, 2, 1)
    flat = tensors[:, [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    axes = fields.principal_axes(flat, hints=np.ones((200, 3)))
    expected = np.linalg.eigh(tensors)[1][:, :, 2]
    assert np.abs(np.abs((axes * expected).sum(axis=1)) - 1).max() < 1e-9
    assert (axes.sum(axis=1) >= 0).all()


SETTINGS = fields.TraceSettings(
    step=0.001, min_length=0, sheet_depth=0.002, min_cosine=0.5, inertia=0.0, voxel_cap=1000, pixel_cap=0,
    clearance=0.0, most=1000,
)  # fmt: skip


def scene(slope: float) -> tuple[fields.VoxelField, fields.FrontSheet]:
    """A sheet of 100 x 100 px (1 mm each) that rises to the right, hair running right on it and nothing behind."""
    box = (40, 40, 40)
    field = fields.VoxelField(
        np.zeros((*box, 3), np.float32), np.full(box, 1.0, np.float32), np.array([-0.1, 0.1, -0.1]), 0.005
    )
    depth = np.broadcast_to(slope * (np.arange(100) - 49.5) * 1e-3, (100, 100)).astype(np.float32)
    direction = np.broadcast_to(np.array([1.0, 0.0], np.float32), (100, 100, 2))
    matrix = np.array([[1000, 0, 0, 50], [0, -1000, 0, 50], [0, 0, 0, 1.0]])
    return field, fields.FrontSheet(depth, direction, matrix)


def test_strands_slide_along_the_sheet():
    field, sheet = scene(0.5)
    found = fields.trace([[0, 0, -0.001, 1, 1]], field=field, sheet=sheet, settings=SETTINGS)
    assert len(found.offsets) == 2
    x, y, z = found.points.T
    assert np.ptp(x) > 0.09
    assert np.abs(y).max() < 1e-9
    assert np.abs(z - (0.5 * x - 0.001))[5:-5].max() < 2e-4


def test_covered_pixels_take_no_second_seed():
    field, sheet = scene(0.0)
    seeds = np.tile([[0.0, 0.0, 0.0, 1, 1]], (1200, 1))
    settings = fields.TraceSettings(**{**vars(SETTINGS), "pixel_cap": 3})
    assert len(fields.trace(seeds, field=field, sheet=sheet, settings=settings).offsets) == 2


def test_shapes_that_do_not_fit_are_refused():
    field, sheet = scene(0.0)
    with pytest.raises(InputError):
        fields.trace([[0, 0, 0]], field=field, sheet=sheet, settings=SETTINGS)
