"""Surfaces against closed forms, laws and openNURBS."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kernel.splines import random_patch, random_uv, rhino_surface
from kernel.surfaces import HALF_CIRCLE, cylinder, plane, sphere

from tress.base.errors import InputError
from tress.kernel import nurbs
from tress.kernel.curves import Curve, evaluate
from tress.kernel.nurbs import Patch, Patches, patch

SEEDS = st.integers(0, 2**32 - 1)


def inner_knots(knots, degree, count, *, seed):
    rng = np.random.default_rng(seed)
    low, high = knots[degree], knots[-degree - 1]
    values, often = np.unique(knots[(knots > low) & (knots < high)], return_counts=True)
    return np.concatenate([rng.uniform(low, high, count), np.repeat(values, rng.integers(0, degree - often + 1))])


def test_a_plane_is_linear_in_both_parameters():
    uv = random_uv(plane(), 30)
    found = nurbs.derivatives(plane(), uv=uv)
    expected = np.column_stack([2 * uv[:, 0], 3 * uv[:, 1], 0.5 + 0 * uv[:, 0]])
    assert np.allclose(found[:, 0], expected, atol=1e-15)
    assert np.allclose(found[:, 1], [2, 0, 0], atol=1e-14)
    assert np.allclose(found[:, 2], [0, 3, 0], atol=1e-14)
    assert np.allclose(found[:, 3:], 0, atol=1e-13)
    assert np.allclose(nurbs.normals(plane(), uv=uv), [0, 0, 1], atol=1e-15)


def test_a_ruled_surface_joins_two_curves_by_straight_lines():
    rng = np.random.default_rng(0)
    rails = rng.uniform(-1, 1, (6, 2, 3))
    ruled = patch(rails, degree_v=1)
    for t in (0.0, 0.3, 1.0):
        ends = [evaluate(Curve(rails[:, j], np.ones(6), ruled.knots_u, 3), at=[t])[0] for j in (0, 1)]
        found = nurbs.evaluate(ruled, uv=[[t, v] for v in (0.0, 0.25, 1.0)])
        assert np.allclose(found, [ends[0], 0.75 * ends[0] + 0.25 * ends[1], ends[1]], atol=1e-15)


def test_a_cylinder_is_round_and_its_normals_point_outwards():
    uv = random_uv(cylinder(), 40)
    found = nurbs.evaluate(cylinder(), uv=uv)
    assert np.allclose(np.hypot(found[:, 0], found[:, 1]), 1, rtol=0, atol=1e-15 * 4)
    outwards = found * [1, 1, 0]
    assert np.allclose(nurbs.normals(cylinder(), uv=uv), outwards, rtol=0, atol=1e-13)


def test_a_sphere_is_round_and_its_normals_hold_at_its_poles():
    uv = random_uv(sphere(), 40)
    found = nurbs.evaluate(sphere(), uv=uv)
    assert np.allclose(np.linalg.norm(found, axis=1), 1, rtol=0, atol=1e-15 * 4)
    assert np.allclose(nurbs.normals(sphere(), uv=uv), found, rtol=0, atol=1e-12)
    poles = np.array([[u, v] for u in (0.0, 2.0) for v in (0.1, 1.5, 3.9)])
    assert np.allclose(nurbs.normals(sphere(), uv=poles), nurbs.evaluate(sphere(), uv=poles), atol=1e-12)


@given(seed=SEEDS)
def test_points_and_normals_are_those_of_opennurbs(seed):
    made = random_patch(seed)
    uv = random_uv(made, 8, seed=seed)
    rhino = rhino_surface(made)
    points = [rhino.PointAt(u, v) for u, v in uv]
    assert np.allclose(nurbs.evaluate(made, uv=uv), [[p.X, p.Y, p.Z] for p in points], rtol=0, atol=1e-12)
    normals = np.array([[n.X, n.Y, n.Z] for n in (rhino.NormalAt(u, v) for u, v in uv[4:])])
    found = nurbs.derivatives(made, uv=uv[4:])
    across = np.cross(found[:, 1], found[:, 2])
    sine = np.linalg.norm(across, axis=1) / np.linalg.norm(found[:, 1:3], axis=2).prod(axis=1)
    clear = sine > 1e-3
    assert np.allclose(nurbs.normals(made, uv=uv[4:])[clear], normals[clear], rtol=0, atol=1e-9)


@given(seed=SEEDS)
def test_derivatives_are_difference_quotients(seed):
    made = random_patch(seed, degrees=(4, 3))
    step = 1e-6
    uv = np.random.default_rng(seed).uniform(0, 1, (6, 2))
    ends = np.array([made.domain_u, made.domain_v])
    uv = ends[:, 0] + 1e-3 + uv * (ends[:, 1] - ends[:, 0] - 2e-3)
    near = [np.abs(uv[:, k, None] - knots).min(axis=1) for k, knots in enumerate((made.knots_u, made.knots_v))]
    uv = uv[(np.min(near, axis=0) > 2 * step)]
    found = nurbs.derivatives(made, uv=uv)
    for direction, pairs in ((0, ((1, 0), (3, 1), (4, 2))), (1, ((2, 0), (4, 1), (5, 2)))):
        offset = step * np.eye(2)[direction]
        ahead, back = nurbs.derivatives(made, uv=uv + offset), nurbs.derivatives(made, uv=uv - offset)
        for derivative, of in pairs:
            expected = (ahead[:, of] - back[:, of]) / (2 * step)
            scale = 1 + np.abs(expected).max(initial=0)
            assert np.allclose(found[:, derivative], expected, rtol=0, atol=1e-4 * scale)


@given(seed=SEEDS, more=st.integers(0, 12))
def test_new_knots_change_no_point(seed, more):
    made = random_patch(seed)
    knots_u = inner_knots(made.knots_u, made.degree_u, more, seed=seed)
    knots_v = inner_knots(made.knots_v, made.degree_v, more // 2, seed=seed + 1)
    refined = nurbs.refine(made, knots_u=knots_u, knots_v=knots_v)
    assert refined.points.shape[:2] == (len(made.points) + len(knots_u), made.points.shape[1] + len(knots_v))
    uv = random_uv(made, 20, seed=seed)
    assert np.allclose(nurbs.evaluate(refined, uv=uv), nurbs.evaluate(made, uv=uv), rtol=0, atol=1e-12)


@given(seed=SEEDS)
def test_clamped_patches_are_the_same_and_have_their_corners_in_their_points(seed):
    made = random_patch(seed, clamped=False)
    clamped = nurbs.clamp(made)
    uv = random_uv(made, 10, seed=seed)
    found = nurbs.evaluate(made, uv=uv)
    assert np.allclose(nurbs.evaluate(clamped, uv=uv), found, rtol=0, atol=1e-10)
    assert np.allclose(clamped.points[[0, 0, -1, -1], [0, -1, 0, -1]], found[:4], rtol=0, atol=1e-10)


@given(seed=SEEDS)
def test_affine_maps_transposition_and_reversal(seed):
    made = random_patch(seed)
    uv = random_uv(made, 8, seed=seed)
    found = nurbs.evaluate(made, uv=uv)
    rng = np.random.default_rng(seed)
    matrix, offset = rng.normal(size=(3, 3)), rng.normal(size=3)
    knots = (made.knots_u, made.knots_v, made.degree_u, made.degree_v)
    moved = Patch(made.points @ matrix.T + offset, made.weights, *knots)
    assert np.allclose(nurbs.evaluate(moved, uv=uv), found @ matrix.T + offset, rtol=0, atol=1e-12)
    assert np.allclose(nurbs.evaluate(made.transposed(), uv=uv[:, ::-1]), found, rtol=0, atol=1e-14)
    low, high = made.domain_u
    back = np.column_stack([np.clip(low + (high - uv[:, 0]), low, high), uv[:, 1]])
    assert np.allclose(nurbs.evaluate(made.reversed_u(), uv=back), found, rtol=0, atol=1e-12)


@given(seed=SEEDS)
def test_all_points_lie_in_the_hull_of_their_control_points(seed):
    made = random_patch(seed)
    found = nurbs.evaluate(made, uv=random_uv(made, 20, seed=seed))
    for direction in np.random.default_rng(seed).normal(size=(5, 3)):
        reach = made.points @ direction
        assert reach.min() - 1e-12 <= (found @ direction).min()
        assert (found @ direction).max() <= reach.max() + 1e-12


def test_a_batch_is_its_patches_one_by_one():
    patches = [random_patch(seed) for seed in range(30)]
    many = Patches.of(patches)
    assert len(many) == 30
    for made, again in zip(patches, (many[i] for i in range(30)), strict=True):
        assert all(np.array_equal(getattr(made, name), getattr(again, name)) for name in vars(made))
    u, v = np.linspace(0, 1, 5), np.array([0, 0.3, 1])
    grids = nurbs.evaluate_grid(many, u=u, v=v)
    index = np.arange(30).repeat(15)
    fractions = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1).reshape(-1, 2)
    low, high = (np.array([[p.domain_u[k], p.domain_v[k]] for p in patches]) for k in (0, 1))
    uv = (low[:, None] * (1 - fractions) + high[:, None] * fractions).reshape(-1, 2)
    uv = np.clip(uv, low[index], high[index])
    one_by_one = nurbs.evaluate(many, uv=uv, index=index)
    assert np.allclose(grids.reshape(-1, 3), one_by_one, rtol=0, atol=1e-14)
    assert np.array_equal(nurbs.normals(many, uv=uv, index=index)[15:30], nurbs.normals(patches[1], uv=uv[15:30]))
    assert nurbs.evaluate_grid(Patches.of([]), u=u, v=v).shape == (0, 5, 3, 3)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"knots_u": [0, 0, 0, 0, 1, 0.5, 1, 1, 1]}, "surface 0: knot 5 is 0.5, less than the 1 before it"),
        ({"knots_v": [0, 1]}, "knots_v has 2 knots; 8 for 4 control points of degree 3 were expected"),
        ({"weights": np.zeros((5, 4))}, "weight 0 is 0; a positive number was expected"),
        ({"weights": np.full((5, 4), np.nan)}, "weights holds numbers that are not finite"),
        ({"weights": np.ones((4, 5))}, "weights has shape"),
        ({"degree_v": 4}, "4 control points were given for degree 4; at least 5 were expected"),
        ({"degree_u": 9}, "degree is 9; 1 to 7 was expected"),
        ({"points": [[[0, 0, 0], [1, 1, 1]], [[0, 0, 0]]]}, "points is ragged"),
        ({"points": np.full((5, 4, 3), np.inf)}, "points holds numbers that are not finite"),
    ],
)
def test_what_makes_no_patch_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        patch(**({"points": np.zeros((5, 4, 3))} | change))


def test_flat_arrays_that_do_not_belong_together_are_refused():
    many = Patches.of([random_patch(0), random_patch(1)])
    parts = vars(many)
    for name, message in (
        ("weights", "weights were given"),
        ("knots_u", "knots along u were given"),
        ("points", "coordinates of control points were given"),
    ):
        with pytest.raises(InputError, match=message):
            nurbs.check(Patches(**(parts | {name: parts[name][:-1]})))
    with pytest.raises(InputError, match="surface 1: the degree is"):
        nurbs.check(Patches(**(parts | {"degrees": np.array([many.degrees[0], [0, 1]])})))
    with pytest.raises(InputError, match="query 0 names surface 2 of 2"):
        nurbs.evaluate(many, uv=[[0.0, 0.0]], index=[2])
    with pytest.raises(InputError, match="fractions from 0 to 1"):
        nurbs.evaluate_grid(many, u=[0, 1.1], v=[0])


def test_half_circles_are_the_profile_of_the_sphere():
    assert np.allclose(np.linalg.norm(evaluate(HALF_CIRCLE, at=np.linspace(0, 2, 9)), axis=1), 1)


def test_closest_points_of_a_sphere_and_of_a_plane():
    rng = np.random.default_rng(0)
    outwards = rng.normal(size=(40, 3))
    outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
    for radius in (0.2, 1.0, 3.0):
        found = nurbs.closest_points(sphere(), queries=radius * outwards)
        assert np.allclose(found.points, outwards, atol=1e-7)
        assert np.allclose(found.distance, abs(radius - 1), atol=1e-14)
    assert np.allclose(nurbs.closest_points(sphere(), queries=[[0, 0, 0], [0, 0, 2]]).distance, 1)
    queries = rng.uniform(-1, 4, (40, 3))
    found = nurbs.closest_points(plane(), queries=queries)
    expected = np.clip(queries, [0, 0, 0.5], [2, 3, 0.5])
    assert np.allclose(found.points, expected, atol=1e-12)


@given(seed=SEEDS)
def test_no_sample_is_closer_than_the_closest_point(seed):
    rng = np.random.default_rng(seed)
    wild = random_patch(seed)
    across, along = np.meshgrid(*(np.linspace(-1, 1, n) for n in wild.points.shape[:2]), indexing="ij")
    sheet = np.stack([across, along, 0 * along], axis=-1) + 0.15 * wild.points
    made = Patch(sheet, wild.weights, wild.knots_u, wild.knots_v, wild.degree_u, wild.degree_v)
    queries = rng.uniform(-1.5, 1.5, (5, 3))
    found = nurbs.closest_points(made, queries=queries)
    fractions = np.linspace(0, 1, 60)
    samples = nurbs.evaluate_grid(made, u=fractions, v=fractions).reshape(-1, 3)
    brute = np.linalg.norm(samples - queries[:, None], axis=2).min(axis=1)
    assert (found.distance <= brute + 1e-12).all()
    assert np.allclose(nurbs.evaluate(made, uv=found.uv), found.points, atol=1e-13)


@given(seed=SEEDS)
def test_a_fit_gives_back_the_patch_that_the_points_come_from(seed):
    made = random_patch(seed, degrees=(3, 2), clamped=True, rational=False)
    sides = []
    for knots in (made.knots_u, made.knots_v):
        breaks = np.unique(knots)
        sides.append(np.concatenate([np.linspace(a, b, 8) for a, b in pairwise(breaks)]))
    uv = np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1).reshape(-1, 2)
    points = nurbs.evaluate(made, uv=uv)
    shape = {"counts": made.points.shape[:2], "degrees": (3, 2), "knots_u": made.knots_u, "knots_v": made.knots_v}
    for fix_corners in (False, True):
        found = nurbs.fit(points, uv=uv, fix_corners=fix_corners, **shape)
        assert np.allclose(found.points, made.points, rtol=0, atol=1e-10)


def test_a_grid_of_points_is_fitted_by_its_chord_lengths():
    x, y = np.meshgrid(np.linspace(0, 1, 30), np.linspace(0, 1, 12), indexing="ij")
    points = np.stack([x, y, 0.1 * np.sin(3 * x) * y], axis=-1)
    uv = nurbs.grid_parameters(points)
    assert np.allclose(uv[:, 0, 0], uv[:, -1, 0])
    found = nurbs.fit(points.reshape(-1, 3), uv=uv.reshape(-1, 2), counts=(8, 4))
    assert nurbs.closest_points(found, queries=points.reshape(-1, 3)).distance.max() < 2e-3
    with pytest.raises(InputError, match="not determined"):
        nurbs.fit(points[:, :1].reshape(-1, 3), uv=uv[:, :1].reshape(-1, 2), counts=(8, 4), knots_v=[0] * 4 + [1] * 4)
