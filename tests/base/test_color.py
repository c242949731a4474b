"""sRGB transfer: fixed points, inverse, bytes round trip."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tress.base.color import linear_to_srgb, linear_to_srgb8, luminance, srgb_to_linear


def test_every_byte_survives_the_round_trip():
    every = np.arange(256, dtype=np.uint8)
    assert np.array_equal(linear_to_srgb8(srgb_to_linear(every)), every)


def test_closed_form():
    assert np.allclose(srgb_to_linear(np.array([0.0, 0.04, 0.5, 1.0])), [0, 0.04 / 12.92, 0.21404114, 1], atol=1e-6)


@given(st.floats(0, 1))
def test_inverse(value):
    assert abs(srgb_to_linear(linear_to_srgb(np.array([value])))[0] - value) < 2e-6


def test_bytes_and_floats_agree():
    every = np.arange(256, dtype=np.uint8)
    assert np.allclose(srgb_to_linear(every), srgb_to_linear(every / 255.0), atol=1e-6)


def test_out_of_range_is_clipped():
    assert linear_to_srgb8(np.array([-1.0, 2.0])).tolist() == [0, 255]


def test_luminance_of_white_is_one():
    assert abs(luminance(np.ones((2, 3)))[1] - 1) < 1e-6
