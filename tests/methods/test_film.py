"""Moving strips on film, and documents that stand still at a moment."""

from itertools import pairwise

import numpy as np
import pytest
from ball_hair import ball_hair

from tress.methods.strips.film import FilmParams, film_strip, motion_span, moving_turntable, playing_times
from tress.model.document import Document
from tress.model.evaluate import evaluate
from tress.model.keyframes import Keyframes
from tress.model.posed import posed
from tress.model.strip import Strip

HAIR = ball_hair(24, moving=True)


@pytest.mark.parametrize("time", [0.0, 0.4, 1.7])
def test_a_posed_document_shows_the_moment_for_ever(time):
    still = posed(HAIR, time)
    assert not still.of_type(Keyframes)
    assert set(still.records) | set(HAIR.of_type(Keyframes)) == set(HAIR.records)
    for name, mesh in evaluate(HAIR, time).meshes.items():
        for later in (0.0, 5.0):
            assert np.allclose(evaluate(still, later).meshes[name].positions, mesh.positions, atol=1e-6)
    roots = {name: strip.root for name, strip in HAIR.of_type(Strip).items()}
    assert {name: strip.root for name, strip in still.of_type(Strip).items()} == roots


def test_a_document_without_keyframes_is_posed_as_it_is():
    still = posed(HAIR, 0.0)
    assert posed(still, 3.0) is still and motion_span(still) == (0.0, 0.0)
    assert posed(Document({}), 1.0) == Document({})


@pytest.mark.parametrize(("span", "count", "turns"), [(1.5, 45, 3), (4.0, 40, 1), (9.0, 90, 1), (30.0, 200, 1)])
def test_films_last_long_enough_and_hold_whole_motions(span, count, turns):
    times = playing_times(1.0, 1.0 + span, FilmParams(frames_per_sec=10))
    assert len(times) == count
    assert times[0] == 1.0 and max(times) < 1.0 + span
    assert sum(later < sooner for sooner, later in pairwise(times)) == turns - 1
    steps = np.diff(times)
    assert np.allclose(steps[steps > 0], 0.1, atol=1e-9)


def test_the_film_turns_and_moves():
    params = FilmParams(width=80, height=100, frames_per_sec=2, least_secs=2)
    moving, standing = (list(moving_turntable(item, params=params)) for item in (HAIR, posed(HAIR, 0.0)))
    assert len(moving) == len(standing) == 4 and moving[0].shape == (100, 80, 3)
    assert (moving[0] == standing[0]).mean() > 0.5
    assert (np.abs(moving[1].astype(int) - moving[0]) > 20).mean() > 0.02
    assert (np.abs(moving[1].astype(int) - standing[1]) > 20).mean() > 0.005


def test_moments_stand_side_by_side():
    sheet = film_strip(HAIR, moments=3, height=100)
    assert sheet.shape[1] > 3 * 80 and sheet.dtype == np.uint8
    assert len(np.unique(sheet.reshape(-1, 3), axis=0)) > 50
