"""Orientation of drawn stripes and lines against closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tress.base.errors import InputError
from tress.image.orient import OrientParams, orientation_map
from tress.kernel.image import gabor_responses, orient

ONE_ROUND = OrientParams(rounds=0, kernel_scale=1.0, stretch=1.0)


def stripes(angle, *, size=48, wavelength=4.0):
    """Cosine stripes that run along `angle` with a crest through the middle pixel."""
    y, x = np.mgrid[:size, :size] - size // 2
    return np.cos(2 * np.pi / wavelength * (y * np.cos(angle) - x * np.sin(angle)))


def undirected_degrees(a, b):
    apart = np.abs(a - b) % np.pi
    return np.rad2deg(np.minimum(apart, np.pi - apart))


@given(st.floats(0, 3.14159))
def test_crests_run_along_the_stripes(angle):
    found = orientation_map(stripes(angle), mask=np.ones((48, 48), bool), params=ONE_ROUND)
    assert undirected_degrees(found.angle[24, 24], angle) < 0.2


def test_angles_on_the_bins_are_multiples_of_their_distance():
    params = OrientParams(rounds=0, kernel_scale=1.0, stretch=1.0, angles="bins")
    found = orientation_map(stripes(0.3), mask=np.ones((48, 48), bool), params=params)
    bins = found.angle / (np.pi / 32)
    np.testing.assert_allclose(bins, np.rint(bins), atol=1e-4)


def test_kernels_have_zero_mean_and_unit_norm():
    impulse = np.zeros((41, 41))
    impulse[20, 20] = 1
    kernels = gabor_responses(impulse)
    np.testing.assert_allclose(kernels.sum(axis=(1, 2)), 0, atol=1e-6)
    np.testing.assert_allclose((kernels**2).sum(axis=(1, 2)), 1, atol=1e-5)


def test_a_constant_picture_has_no_confidence():
    found = orientation_map(np.full((30, 30), 0.7), mask=np.ones((30, 30), bool))
    assert not found.confidence.any()


def test_outside_the_mask_nothing_is_given():
    mask = np.zeros((48, 48), bool)
    mask[10:30, 10:30] = True
    found = orientation_map(stripes(1.0), mask=mask, params=OrientParams(margin_px=0))
    assert np.isnan(found.angle[~mask]).all()
    assert np.isfinite(found.angle[mask]).all()
    assert not found.confidence[~mask].any()


def test_a_shape_that_does_not_fit_and_nan_are_refused():
    with pytest.raises(InputError, match="mask"):
        orient(np.zeros((4, 5)), mask=np.ones((5, 4), bool))
    with pytest.raises(InputError, match="finite"):
        orient(np.full((4, 5), np.nan), mask=np.ones((4, 5), bool))
