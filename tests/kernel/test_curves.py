"""Curves against closed forms, laws, SciPy, openNURBS and Böhm's insertion."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kernel.splines import boehm, parameters, random_curve, rhino_curve, scipy_curve

from tress.base.errors import InputError
from tress.kernel import curves
from tress.kernel.curves import Curve, curve

SEEDS = st.integers(0, 2**32 - 1)
HALF = np.sqrt(0.5)


def circle(radius=1.0) -> Curve:
    """The whole circle about the origin as four rational quadratic quarters."""
    corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    points = radius * np.column_stack([corners, np.zeros(9)])
    weights = [1, HALF, 1, HALF, 1, HALF, 1, HALF, 1]
    return curve(points, degree=2, weights=weights, knots=[0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4])


def inner_knots(made, count, *, seed):
    """Random knots inside the domain, among them old ones as often as still allowed."""
    rng = np.random.default_rng(seed)
    fresh = rng.uniform(*made.domain, count)
    low, high = made.domain
    inner = made.knots[(made.knots > low) & (made.knots < high)]
    values, often = np.unique(inner, return_counts=True)
    return np.concatenate([fresh, np.repeat(values, rng.integers(0, made.degree - often + 1))])


def test_a_rational_quadratic_is_the_circle():
    found = curves.evaluate(circle(2.0), at=np.linspace(0, 4, 101))
    assert np.allclose(np.hypot(found[:, 0], found[:, 1]), 2.0, rtol=0, atol=1e-15 * 8)
    _, first, second = curves.derivatives(circle(), at=[0.3]).reshape(3, 3)
    curvature = np.linalg.norm(np.cross(first, second)) / np.linalg.norm(first) ** 3
    assert abs(curvature - 1) < 1e-14


def test_a_cubic_is_its_polynomial():
    """Control points of Bernstein form: the polynomial t, t^2, t^3."""
    moment = curve([[0, 0, 0], [1 / 3, 0, 0], [2 / 3, 1 / 3, 0], [1, 1, 1]])
    t = np.linspace(0, 1, 23)
    found = curves.derivatives(moment, at=t)
    assert np.allclose(found[:, 0], np.stack([t, t**2, t**3], axis=1), atol=1e-15)
    assert np.allclose(found[:, 1], np.stack([1 + 0 * t, 2 * t, 3 * t**2], axis=1), atol=1e-14)
    assert np.allclose(found[:, 2], np.stack([0 * t, 2 + 0 * t, 6 * t], axis=1), atol=1e-14)


@given(seed=SEEDS)
def test_points_are_those_of_scipy_and_of_opennurbs(seed):
    made = random_curve(seed)
    at = parameters(made.domain, 20, seed=seed)
    found = curves.evaluate(made, at=at)
    homogeneous = scipy_curve(made)(at)
    assert np.allclose(found, homogeneous[:, :3] / homogeneous[:, 3:], rtol=0, atol=1e-12)
    rhino = rhino_curve(made)
    assert np.allclose(found, [[p.X, p.Y, p.Z] for p in map(rhino.PointAt, at)], rtol=0, atol=1e-12)


@given(seed=SEEDS)
def test_derivatives_are_those_of_scipy_and_of_opennurbs(seed):
    made = random_curve(seed)
    at = parameters(made.domain, 12, seed=seed)[1:-1]
    found = curves.derivatives(made, at=at)
    spline = scipy_curve(made)
    (a, w), (a1, w1), (a2, w2) = ((h[:, :3], h[:, 3:]) for h in (spline(at), spline(at, 1), spline(at, 2)))
    first = (a1 - w1 * found[:, 0]) / w
    second = (a2 - 2 * w1 * first - w2 * found[:, 0]) / w
    scale = 1 + np.abs(second).max()
    assert np.allclose(found[:, 1], first, rtol=0, atol=1e-11 * scale)
    assert np.allclose(found[:, 2], second, rtol=0, atol=1e-11 * scale)
    rhino = rhino_curve(made)
    theirs = np.array([[[d.X, d.Y, d.Z] for d in rhino.DerivativeAt(t, 2)] for t in at])
    assert np.allclose(found, theirs, rtol=0, atol=1e-11 * scale)


@given(seed=SEEDS, more=st.integers(1, 30))
def test_new_knots_change_no_point(seed, more):
    made = random_curve(seed)
    knots = inner_knots(made, more, seed=seed)
    refined = curves.refine(made, knots=knots)
    assert np.array_equal(refined.knots, np.sort(np.concatenate([made.knots, knots])))
    at = np.concatenate([parameters(made.domain, 30, seed=seed), knots])
    assert np.allclose(curves.evaluate(refined, at=at), curves.evaluate(made, at=at), rtol=0, atol=1e-12)


@given(seed=SEEDS)
def test_the_oslo_algorithm_gives_boehms_points(seed):
    made = random_curve(seed, clamped=True)
    knots = inner_knots(made, 6, seed=seed)
    expected = made
    for knot in knots:
        expected = boehm(expected, knot)
    found = curves.refine(made, knots=knots)
    assert np.allclose(found.points, expected.points, rtol=0, atol=1e-12)
    assert np.allclose(found.weights, expected.weights, rtol=1e-12)


@given(seed=SEEDS)
def test_clamped_and_cut_curves_are_the_same_curve(seed):
    made = random_curve(seed)
    clamped = curves.clamp(made)
    low, high = made.domain
    assert np.allclose(clamped.points[[0, -1]], curves.evaluate(made, at=[low, high]), rtol=0, atol=1e-11)
    at = parameters(made.domain, 20, seed=seed)
    assert np.allclose(curves.evaluate(clamped, at=at), curves.evaluate(made, at=at), rtol=0, atol=1e-11)
    third, half = low + (high - low) / 3, (low + high) / 2
    inner = clamped.knots[(clamped.knots > third) & (clamped.knots < half)]
    ends = np.repeat([third, half], made.degree + 1)
    part = curves.over_knots(clamped, knots=np.sort(np.concatenate([ends, inner])))
    at = np.linspace(third, half, 9)
    assert np.allclose(curves.evaluate(part, at=at), curves.evaluate(made, at=at), rtol=0, atol=1e-11)


@given(seed=SEEDS)
def test_affine_maps_of_the_points_map_the_curve(seed):
    made = random_curve(seed)
    rng = np.random.default_rng(seed)
    matrix, offset = rng.normal(size=(3, 3)), rng.normal(size=3)
    moved = Curve(made.points @ matrix.T + offset, made.weights, made.knots, made.degree)
    at = parameters(made.domain, 9, seed=seed)
    expected = curves.evaluate(made, at=at) @ matrix.T + offset
    assert np.allclose(curves.evaluate(moved, at=at), expected, rtol=0, atol=1e-12)


@given(seed=SEEDS)
def test_equal_points_give_a_point_and_all_points_lie_in_the_box_of_their_control_points(seed):
    made = random_curve(seed)
    at = parameters(made.domain, 15, seed=seed)
    one = Curve(np.full_like(made.points, 0.7), made.weights, made.knots, made.degree)
    assert np.allclose(curves.evaluate(one, at=at), 0.7, rtol=0, atol=1e-14)
    assert np.allclose(curves.derivatives(one, at=at)[:, 1:], 0, atol=1e-9)
    for direction in np.random.default_rng(seed).normal(size=(5, 3)):
        found = curves.evaluate(made, at=at) @ direction
        reach = made.points @ direction
        assert reach.min() - 1e-12 <= found.min() <= found.max() <= reach.max() + 1e-12


@given(seed=SEEDS)
def test_ends_of_clamped_curves_are_their_first_and_last_points(seed):
    made = random_curve(seed, clamped=True)
    found = curves.evaluate(made, at=made.domain)
    assert np.allclose(found, made.points[[0, -1]], rtol=0, atol=1e-15)


@given(seed=SEEDS)
def test_derivatives_are_difference_quotients(seed):
    made = random_curve(seed, degree=4)
    low, high = made.domain
    step = 1e-6 * (high - low)
    at = parameters((low + step, high - step), 10, seed=seed)[1:-1]
    far = np.abs(at[:, None] - made.knots).min(axis=1) > 2 * step
    before, middle, after = (curves.derivatives(made, at=at[far] + s * step) for s in (-1, 0, 1))
    for order in (1, 2):
        expected = (after[:, order - 1] - before[:, order - 1]) / (2 * step)
        assert np.allclose(middle[:, order], expected, rtol=1e-4, atol=1e-4 * (1 + np.abs(expected).max(initial=0)))


@given(seed=SEEDS)
def test_reversed_curves_run_backwards(seed):
    made = random_curve(seed)
    low, high = made.domain
    back = made.reversed()
    assert back.domain == made.domain
    at = parameters(made.domain, 9, seed=seed)
    found = curves.evaluate(back, at=np.clip(low + (high - at), low, high))
    assert np.allclose(found, curves.evaluate(made, at=at), rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"knots": [0, 0, 0, 0, 1, 0.5, 1, 1, 1]}, "knot 5 is 0.5, less than the 1 before it"),
        ({"knots": [0, 0, 1, 1]}, "4 knots were given for 5 control points of degree 3; 9 were expected"),
        ({"knots": [0] * 9}, "domain runs from 0 to 0"),
        ({"knots": [0, 0, 0, 0, 0, 1, 1, 1, 1]}, "knot 0 occurs 5 times; at most 4"),
        ({"knots": [0, 0, 0, 0, np.nan, 1, 1, 1, 1]}, "knots holds numbers that are not finite"),
        ({"weights": [1, 1, 0, 1, 1]}, "weight 2 is 0; a positive number was expected"),
        ({"weights": [1, 1, -2, 1, 1]}, "weight 2 is -2"),
        ({"weights": [1, 1]}, "2 weights were given; 5 were expected"),
        ({"degree": 5}, "5 control points were given for degree 5; at least 6 were expected"),
        ({"degree": 0}, "degree is 0; 1 to 7 was expected"),
        ({"degree": 8}, "degree is 8; 1 to 7 was expected"),
        ({"points": np.full((5, 3), np.nan)}, "points holds numbers that are not finite"),
        ({"points": [[0, 0, 0], [1, 1]]}, "points is ragged"),
        ({"points": np.zeros((5, 2))}, "points has shape"),
    ],
)
def test_what_makes_no_curve_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        curve(**({"points": np.zeros((5, 3)), "degree": 3} | change))


def test_questions_outside_the_domain_are_refused():
    made = random_curve(3, degree=3)
    with pytest.raises(InputError, match="outside the domain"):
        curves.evaluate(made, at=[made.domain[1] + 0.01])
    with pytest.raises(InputError, match="outside the domain"):
        curves.refine(made, knots=[made.domain[0]])
    with pytest.raises(InputError, match="lack the old knot"):
        curves.over_knots(circle(), knots=[0, 0, 0, 4, 4, 4])
    with pytest.raises(InputError, match="at most 3 times"):
        curves.refine(curve(np.zeros((4, 3))), knots=[0.5] * 4)


def test_length_of_a_circle_and_parameters_at_lengths():
    assert abs(curves.length(circle(2.0), accuracy=1e-12) - 4 * np.pi) < 1e-11
    wanted = np.linspace(0, 2 * np.pi, 33)
    at = curves.parameters_at(circle(), lengths=np.minimum(wanted, curves.length(circle())), accuracy=1e-12)
    found = curves.evaluate(circle(), at=at)
    assert np.allclose(found, np.column_stack([np.cos(wanted), np.sin(wanted), 0 * wanted]), atol=1e-10)


@given(seed=SEEDS)
def test_lengths_are_those_of_fine_polylines_and_parameters_come_back(seed):
    made = random_curve(seed)
    at = np.sort(parameters(made.domain, 9, seed=seed))
    found = curves.lengths(made, at=at, accuracy=1e-10)
    corners = made.knots[(made.knots > at[0]) & (made.knots < at[-1])]
    fine = np.sort(np.concatenate([np.linspace(*made.domain, 20001), corners]))
    chords = np.linalg.norm(np.diff(curves.evaluate(made, at=fine), axis=0), axis=1)
    polyline = np.concatenate([[0], np.cumsum(chords)])
    assert np.allclose(found, np.interp(at, fine, polyline), rtol=0, atol=1e-4 * polyline[-1])
    assert abs(found[-1] - polyline[-1]) < 1e-5 * polyline[-1]
    again = curves.lengths(made, at=curves.parameters_at(made, lengths=found, accuracy=1e-10), accuracy=1e-10)
    assert np.allclose(again, found, rtol=0, atol=1e-9 * polyline[-1])


@given(seed=SEEDS)
@settings(max_examples=20, deadline=None)
def test_a_curve_by_arc_length_is_the_same_path_at_unit_speed(seed):
    steps = np.random.default_rng(seed).normal(0, 0.3, (8, 3))
    made = curve(np.cumsum(steps + [1, 0, 0], axis=0), weights=3.0 ** steps[:, 0])
    found = curves.by_arc_length(made, accuracy=1e-4)
    total = curves.length(made)
    assert found.deviation <= 1e-4
    assert np.allclose(found.curve.domain, [0, total], rtol=0, atol=1e-5)
    wanted = np.linspace(0, min(total, found.curve.domain[1]), 50)
    expected = curves.evaluate(made, at=curves.parameters_at(made, lengths=wanted))
    assert np.allclose(curves.evaluate(found.curve, at=wanted), expected, rtol=0, atol=5e-4)


def test_an_arc_by_arc_length_has_unit_speed():
    found = curves.by_arc_length(circle(), accuracy=1e-8).curve
    speed = np.linalg.norm(curves.derivatives(found, at=np.linspace(*found.domain, 99))[:, 1], axis=1)
    assert np.allclose(speed, 1, rtol=0, atol=1e-4)
    with pytest.raises(InputError, match="has no length"):
        curves.by_arc_length(curve(np.ones((4, 3))))
    with pytest.raises(InputError, match="length 7 lies outside 0 to"):
        curves.parameters_at(circle(), lengths=[7.0])


def test_closest_points_of_a_circle():
    angles = np.linspace(0.1, 6.2, 30)
    outwards = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    for radius in (0.3, 1.0, 5.0):
        found = curves.closest_points(circle(), queries=radius * outwards + [0, 0, 0.4])
        assert np.allclose(found.points, outwards, atol=1e-9)
        assert np.allclose(found.distance, np.hypot(radius - 1, 0.4), atol=1e-14)
    centre = curves.closest_points(circle(), queries=[[0, 0, 0]])
    assert np.allclose(centre.distance, 1)


@given(seed=SEEDS)
def test_no_sample_is_closer_than_the_closest_point(seed):
    made = random_curve(seed)
    queries = np.random.default_rng(seed).uniform(-1.5, 1.5, (10, 3))
    found = curves.closest_points(made, queries=queries)
    samples = curves.evaluate(made, at=np.linspace(*made.domain, 2001))
    brute = np.linalg.norm(samples - queries[:, None], axis=2).min(axis=1)
    assert (found.distance <= brute + 1e-12).all()
    assert np.allclose(curves.evaluate(made, at=found.parameter), found.points, atol=1e-13)
    assert np.allclose(np.linalg.norm(found.points - queries, axis=1), found.distance, atol=1e-13)


@given(seed=SEEDS)
def test_a_fit_gives_back_the_curve_that_the_points_come_from(seed):
    made = random_curve(seed, clamped=True, rational=False)
    breaks = np.unique(made.knots)
    at = np.concatenate([np.linspace(a, b, 20) for a, b in pairwise(breaks)])
    for fix_ends in (True, False):
        found = curves.fit(
            curves.evaluate(made, at=at),
            parameters=at,
            count=len(made.points),
            degree=made.degree,
            knots=made.knots,
            fix_ends=fix_ends,
        )
        assert np.allclose(found.points, made.points, rtol=0, atol=1e-10)


def test_a_fit_is_the_least_squares_solution_of_numpy():
    rng = np.random.default_rng(0)
    points = np.cumsum(rng.normal(size=(60, 3)), axis=0)
    found = curves.fit(points, count=9, fix_ends=False)
    at = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    design = scipy_curve(curve(np.zeros((9, 3)), knots=found.knots)).design_matrix(at / at[-1], found.knots, 3)
    expected = np.linalg.lstsq(design.toarray(), points, rcond=None)[0]
    assert np.allclose(found.points, expected, rtol=0, atol=1e-10)
    fixed = curves.fit(points, count=9)
    assert np.allclose(fixed.points[[0, -1]], points[[0, -1]], atol=1e-15)


def test_smoothness_straightens_and_settles_free_control_points():
    rng = np.random.default_rng(1)
    points = np.column_stack([np.linspace(0, 1, 200), rng.normal(0, 0.05, 200), np.zeros(200)])
    bends = [
        np.abs(np.diff(curves.fit(points, count=20, smoothness=s).points, 2, axis=0)).sum() for s in (0, 0.1, 10, 1e4)
    ]
    assert bends == sorted(bends, reverse=True)
    gap = points[(points[:, 0] < 0.3) | (points[:, 0] > 0.7)]
    knots = curves.uniform_knots(20, degree=3)
    with pytest.raises(InputError, match="control point 9 is not determined"):
        curves.fit(gap, parameters=gap[:, 0], knots=knots, count=20)
    settled = curves.fit(gap, parameters=gap[:, 0], knots=knots, count=20, smoothness=0.1)
    assert np.abs(settled.points[:, 1]).max() < 0.1
    with pytest.raises(InputError, match="5 points were given to fit 9 control points"):
        curves.fit(points[:5], count=9)
