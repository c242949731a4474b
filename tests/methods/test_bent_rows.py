"""Rows of a level lie where a strip bends."""

import numpy as np
import pytest
from ball_hair import ball_hair
from hypothesis import given
from hypothesis import strategies as st

from tress.base.errors import InputError
from tress.methods.strips.bent_rows import bent_rows
from tress.methods.strips.levels import shown_strips
from tress.model.level import Level, level_surface
from tress.model.strip_set import resting_points


def bow(turn, straight, count=400):
    """An arc of radius 1 over `turn` radians, and then a straight line: points at even lengths."""
    length = np.linspace(0, turn + straight, count)
    on_arc = np.minimum(length, turn)
    rest = (length - on_arc)[:, None] * [np.cos(turn), -np.sin(turn), 0]
    return np.column_stack([np.sin(on_arc), np.cos(on_arc), 0 * on_arc]) + rest


def chord_error(line, rows):
    place = np.linspace(0, 1, len(line))
    knots = np.column_stack([np.interp(rows, place, axis) for axis in line.T])
    follows = np.column_stack([np.interp(place, rows, axis) for axis in knots.T])
    return np.linalg.norm(follows - line, axis=1).max()


@pytest.mark.parametrize("pieces", [2, 4, 6, 9])
def test_bent_lines_are_followed_more_closely_than_with_even_rows(pieces):
    line = bow(1.2, 4.0)
    assert chord_error(line, bent_rows(line, pieces)) < 0.5 * chord_error(line, np.linspace(0, 1, pieces + 1))


def test_arcs_and_straight_lines_are_divided_evenly():
    for line in (bow(1.5, 0.0), bow(0.0, 2.0), np.zeros((20, 3))):
        assert np.allclose(bent_rows(line, 5), np.linspace(0, 1, 6), atol=0.02)


@given(st.integers(1, 40), st.integers(0, 1000), st.integers(2, 30))
def test_rows_rise_from_end_to_end(pieces, seed, points):
    rows = bent_rows(np.random.default_rng(seed).normal(size=(points, 3)).cumsum(axis=0), pieces)
    assert rows.shape == (pieces + 1,) and rows[0] == 0 and rows[-1] == 1 and (np.diff(rows) > 0).all()


def test_vertices_lie_at_the_rows():
    hair = ball_hair(6)
    names = shown_strips(hair)[:3]
    rows = (np.array([0, 0.1, 0.3, 1]), np.linspace(0, 1, 3), np.array([0, 1.0]))
    level = Level(names, np.array([[3, 2], [2, 1], [1, 1]]), np.ones(3), rows)
    surface = level_surface(hair, level)
    assert np.allclose(surface.grid.fraction[surface.grid.strip == 0, 0].reshape(4, 3), rows[0][:, None], atol=1e-12)
    one = level_surface(hair, level.part(np.array([1])))
    mine = surface.grid.points(resting_points(surface.strips))[surface.grid.strip == 1]
    assert np.array_equal(one.grid.points(resting_points(one.strips)), mine)


@pytest.mark.parametrize(
    "rows", [[0, 1.0], [0, 0.5, 0.5, 1], [0.1, 0.2, 0.3, 1], [0, 0.7, 0.4, 1], [0, np.nan, 0.5, 1]]
)
def test_rows_that_do_not_rise_from_0_to_1_are_refused(rows):
    with pytest.raises(InputError, match="4 numbers from 0 to 1 were expected"):
        Level(("a",), np.array([[3, 1]]), np.ones(1), (np.array(rows),))
