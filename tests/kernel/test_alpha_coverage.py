"""Coverage of an alpha test against closed forms and against OpenCV's bilinear enlargement."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from tress.base.errors import InputError
from tress.kernel.alpha_coverage import alpha_coverage, alpha_scale

PICTURES = arrays(np.float32, st.tuples(st.integers(2, 9), st.integers(2, 9)), elements=st.floats(0, 1, width=32))


@settings(max_examples=60, deadline=None)
@given(PICTURES, st.floats(0.05, 0.95))
def test_coverage_counts_an_enlarged_picture(alpha, threshold):
    enlarged = cv2.resize(alpha, None, fx=4, fy=4, interpolation=cv2.INTER_LINEAR)
    doubtful = (np.abs(enlarged - threshold) < 1e-5).mean()
    assert abs(alpha_coverage(alpha, threshold=threshold) - (enlarged > threshold).mean()) <= doubtful + 1e-9


@settings(max_examples=60, deadline=None)
@given(PICTURES, st.floats(0.02, 8), st.floats(1.01, 4))
def test_coverage_never_falls_as_alpha_grows(alpha, factor, more):
    covered = [alpha_coverage(np.minimum(alpha * f, 1), threshold=0.5) for f in (factor, factor * more)]
    assert covered[0] <= covered[1]


@pytest.mark.parametrize("wanted", [0.05, 0.3, 0.5, 0.8])
def test_the_scale_of_a_ramp_has_a_closed_form(wanted):
    """A ramp from 0 to 1, scaled by s, exceeds 1/2 where x > 1 / 2s: the share is 1 - 1 / 2s."""
    ramp = np.tile((np.arange(256) + 0.5) / 256, (4, 1))
    assert alpha_scale(ramp, threshold=0.5, coverage=wanted) == pytest.approx(0.5 / (1 - wanted), rel=2e-3)


def test_pictures_without_texels_and_without_numbers_are_refused():
    for alpha in (np.zeros((0, 4)), np.zeros(4), np.full((2, 2), np.nan)):
        with pytest.raises(InputError):
            alpha_coverage(alpha, threshold=0.5)
