"""Keyframes between their moments: closed forms."""

import numpy as np
import pytest
from documents import keyframes
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline

from tress.base.errors import InputError
from tress.model.document import Document
from tress.model.group import Group
from tress.model.keyframes import Keyframes
from tress.model.tracks import stretched

TIMES = np.array([0.0, 1.0, 1.5, 3.0])
RANDOM = np.random.default_rng(3)
VALUES = RANDOM.normal(size=(4, 2, 3, 3))
BETWEEN = np.linspace(0, 3, 61)


def moving(**changes):
    return Keyframes(**{"target": "strip", "times": TIMES, "values": VALUES} | changes)


def polynomial(degree, times=TIMES):
    """Values of polynomials of the time, and the same at other times."""
    parts = RANDOM.normal(size=(degree + 1, 2, 3, 3))
    return lambda at: np.tensordot(np.vander(np.atleast_1d(at), degree + 1), parts, axes=1)


@given(keyframes(), st.integers(0, 3))
@settings(deadline=None)
def test_at_its_moments_a_motion_has_the_values_given_to_the_bit(motion, moment):
    moment = min(moment, len(motion.times) - 1)
    wanted = motion.values[0 if motion.loop and moment == len(motion.times) - 1 else moment]
    if not motion.loop:
        assert np.array_equal(motion.at(motion.times[moment]), wanted)
    else:
        assert np.allclose(motion.at(motion.times[moment]), wanted, atol=1e-3 + 1e-5 * np.abs(motion.values).max())


def test_linear_is_numpys_interpolation():
    motion = moving(interpolation="linear")
    flat = VALUES.reshape(4, -1)
    for time in BETWEEN:
        wanted = [np.interp(time, TIMES, column) for column in flat.T]
        assert motion.at(time).ravel() == pytest.approx(wanted, abs=1e-14)


def test_step_holds_until_the_next_moment():
    motion = moving(interpolation="step")
    for time in (0.0, 0.99, 1.0, 1.2, 1.5, 2.999, 3.0, 99.0, -1.0):
        moment = max(np.searchsorted(TIMES, time, side="right") - 1, 0)
        assert np.array_equal(motion.at(time), VALUES[moment])


def test_cubic_with_tangents_is_scipys_hermite_spline():
    tangents = RANDOM.normal(size=VALUES.shape)
    motion, spline = moving(tangents=tangents), CubicHermiteSpline(TIMES, VALUES, tangents)
    for time in BETWEEN:
        assert motion.at(time) == pytest.approx(spline(time), abs=1e-13)


def test_cubic_without_tangents_gives_parabolas_between_inner_moments_and_lines_everywhere():
    parabola, line = polynomial(2), polynomial(1)
    for time in np.linspace(1, 1.5, 11):
        assert moving(values=parabola(TIMES)).at(time) == pytest.approx(parabola(time)[0], abs=1e-12)
    for time in BETWEEN:
        assert moving(values=line(TIMES)).at(time) == pytest.approx(line(time)[0], abs=1e-12)


def test_cubic_without_tangents_is_catmull_rom_where_times_are_even():
    motion = moving(times=[0, 1, 2, 3])
    p0, p1, p2, p3 = VALUES
    for s in (0.1, 0.5, 0.9):
        wanted = p1 + s / 2 * (p2 - p0 + s * (2 * p0 - 5 * p1 + 4 * p2 - p3 + s * (3 * (p1 - p2) + p3 - p0)))
        assert motion.at(1 + s) == pytest.approx(wanted, abs=1e-14)


def test_outside_the_motion_stands_still_or_repeats():
    for interpolation in ("linear", "cubic", "step"):
        motion = moving(interpolation=interpolation)
        assert np.array_equal(motion.at(-7.0), VALUES[0])
        assert np.array_equal(motion.at(7.0), VALUES[-1])
        loop = moving(interpolation=interpolation, loop=True)
        assert loop.at(1.25 + 3 * 4) == pytest.approx(loop.at(1.25), abs=1e-12)
        assert loop.at(1.25 - 3 * 4) == pytest.approx(loop.at(1.25), abs=1e-12)


def test_a_smooth_loop_has_no_corner_at_its_seam():
    times = np.linspace(0, 2 * np.pi, 9)
    values = np.sin(times)[:, None, None, None] * np.ones((1, 1, 1, 3))
    values[-1] = values[0]
    loop = Keyframes(target="a", times=times, values=values, loop=True)
    h = 1e-5
    before, after = (loop.at(0.0) - loop.at(-h)) / h, (loop.at(h) - loop.at(0.0)) / h
    assert before == pytest.approx(after, abs=1e-4)


def test_one_moment_is_a_pose():
    motion = moving(times=[2.0], values=VALUES[:1])
    for time in (0.0, 2.0, 5.0):
        assert np.array_equal(motion.at(time), VALUES[0])


def test_stretching_keeps_bilinear_nets_and_corners():
    rows, columns = np.meshgrid(np.linspace(0, 1, 3), np.linspace(0, 1, 4), indexing="ij")
    net = (2 * rows - columns + rows * columns)[None, :, :, None] * np.ones(3)
    found = stretched(net, (7, 2))[0, :, :, 0]
    rows, columns = np.meshgrid(np.linspace(0, 1, 7), np.linspace(0, 1, 2), indexing="ij")
    assert found == pytest.approx(2 * rows - columns + rows * columns, abs=1e-15)
    assert stretched(np.ones((2, 1, 1, 3)), (4, 5)).tolist() == np.ones((2, 4, 5, 3)).tolist()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"times": [0, 1, 1, 2]}, "rising seconds"),
        ({"times": [0, 2, 1, 3]}, "rising seconds"),
        ({"times": [0, 1, 2, 1e12]}, "rising seconds"),
        ({"times": [0, 1, 2]}, "was expected"),
        ({"times": [0, 1, np.nan, 2]}, "not finite"),
        ({"times": [], "values": np.zeros((0, 2, 2, 3))}, "no moment"),
        ({"interpolation": "quintic"}, "one of linear, cubic, step"),
        ({"interpolation": "linear", "tangents": VALUES}, "belong to 'cubic'"),
        ({"kind": "position", "frame": "head"}, "in the frame 'root'"),
        ({"times": [0], "values": VALUES[:1], "loop": True}, "two moments"),
    ],
)
def test_keyframes_refuse(changes, message):
    with pytest.raises(InputError, match=message):
        moving(**changes)


def test_keyframes_of_nothing_are_refused():
    with pytest.raises(InputError, match="no strip or group"):
        Document({"motion": moving()})
    with pytest.raises(InputError, match="not for the control points of 'group'"):
        Document({"group": Group(), "motion": moving(target="group", kind="position")})
