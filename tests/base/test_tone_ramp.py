"""Ramps of flat tones: as many as asked, at the edges that were asked for."""

import numpy as np
import pytest

from tress.base.errors import ParameterError
from tress.base.tone_ramp import ToneParams, above, gleaming, tone_ramp

COSINES = np.linspace(-1, 1, 2001)


def tones(**settings):
    return np.unique(tone_ramp(ToneParams(cool=0.0, **settings)).of(np.ones(3), COSINES)[:, 0].round(5))


@pytest.mark.parametrize("count", [1, 2, 3, 7])
def test_there_are_as_many_tones_as_asked_evenly_from_shade_to_color(count):
    found = tones(tones=count, edge=-0.2003, spread=0.5, shade=0.25)
    expected = np.linspace(0.25, 1, count) if count > 1 else [1.0]
    np.testing.assert_allclose(found, expected, atol=1e-5)


def test_highlights_and_lowlights_are_two_tones_more():
    found = tones(tones=2, edge=0.0003, shade=0.5, highlight=0.9003, gleam=1.0, lowlight=-0.5003, depth=0.5)
    np.testing.assert_allclose(found, [0.25, 0.5, 1.0], atol=1e-5)  # a white highlight on white is the color
    dark = tone_ramp(ToneParams(highlight=0.9, gleam=0.5)).of(np.full(3, 0.25), np.array([0.5, 0.95]))
    np.testing.assert_allclose(dark[:, 0], [0.25, 0.5], atol=1e-6)


def test_an_edge_lies_where_it_was_put():
    ramp = tone_ramp(ToneParams(edge=0.3, shade=0.0))
    beside = np.array([-1.0, 0.0, 0.2999, 0.3001, 1.0])
    assert ramp.of(np.ones(3), beside)[:, 0].tolist() == [0, 0, 0, 1, 1]


def test_an_edge_within_a_pixel_is_shown_by_its_share():
    """A cosine that goes by 0.1 a pixel and is 0.02 above the edge in the middle is above it in 0.7 of the pixel."""
    ramp = tone_ramp(ToneParams(edge=0.3, shade=0.0))
    assert ramp.of(np.ones(3), np.array([0.32]), slope=np.array([0.1]))[0, 0] == pytest.approx(0.7, abs=1e-6)
    assert above(np.array([0.02]), 0.1)[0] == pytest.approx(0.7)


def test_a_cool_shade_turns_to_blue():
    shade = tone_ramp(ToneParams(cool=1.0)).of(np.ones(3), np.array([-1.0]))[0]
    assert shade[0] < shade[1] < shade[2]


def test_gleams_keep_black_from_white():
    assert gleaming(np.zeros(3), gleam=0.4).max() < 0.01 and gleaming(np.full(3, 0.1), gleam=1.0).min() == 1


def test_settings_out_of_range_are_refused():
    with pytest.raises(ParameterError, match="tones is 0"):
        ToneParams(tones=0)
