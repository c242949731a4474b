"""Curves against closed forms, laws, SciPy, openNURBS and Böhm's insertion."""

import numpy as np
import pytest
from hypothesis import given
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
