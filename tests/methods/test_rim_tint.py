"""The rim takes the tint of the hair near it and keeps its brightness, but beside the background."""

import numpy as np
import pytest

from tress.base.color import luminance
from tress.methods.portrait.rim_tint import with_rim_tint

BROWN, PURPLE = np.float32([0.2, 0.12, 0.05]), np.float32([0.2, 0.1, 0.3])


@pytest.fixture
def rim():
    """Brown hair on the left, a purple rim of falling alpha on the right, and the alpha."""
    alpha = np.broadcast_to(np.clip(np.linspace(3.0, 0.0, 40), 0, 1), (30, 40)).astype(np.float32)
    return np.where(alpha[..., None] < 0.97, PURPLE, BROWN), alpha


def test_the_rim_takes_the_tint_and_keeps_its_brightness(rim):
    color, alpha = rim
    tinted = with_rim_tint(color, foreground=color, alpha=alpha, outer=np.zeros(alpha.shape, bool), amount=1.0)
    thin = (alpha < 0.6) & (alpha > 0.3)
    np.testing.assert_allclose(luminance(tinted), luminance(color), rtol=1e-4)
    expected = BROWN * (luminance(PURPLE[None]) / luminance(BROWN[None]))
    np.testing.assert_allclose(tinted[thin], np.broadcast_to(expected, tinted[thin].shape), rtol=1e-3)


def test_solid_hair_and_amount_zero_stay(rim):
    color, alpha = rim
    tinted = with_rim_tint(color, foreground=color, alpha=alpha, outer=np.zeros(alpha.shape, bool), amount=1.0)
    assert np.array_equal(tinted[alpha > 0.97], color[alpha > 0.97])
    assert np.array_equal(
        with_rim_tint(color, foreground=color, alpha=alpha, outer=np.zeros(alpha.shape, bool), amount=0.0), color
    )


def test_rims_far_from_solid_hair_stay():
    color = np.broadcast_to(PURPLE, (30, 40, 3)).astype(np.float32)
    alpha = np.full((30, 40), 0.4, np.float32)
    assert np.array_equal(
        with_rim_tint(color, foreground=color, alpha=alpha, outer=np.zeros(alpha.shape, bool), amount=1.0), color
    )


def test_beside_the_background_a_bright_rim_darkens_to_the_hair_near_it(rim):
    color, alpha = rim
    bright = np.where(alpha[..., None] < 0.97, 5 * PURPLE, BROWN).astype(np.float32)
    tinted = with_rim_tint(bright, foreground=bright, alpha=alpha, outer=np.ones(alpha.shape, bool), amount=1.0)
    thin = (alpha < 0.6) & (alpha > 0.3)
    np.testing.assert_allclose(tinted[thin], np.broadcast_to(BROWN, tinted[thin].shape), rtol=0.02)
