"""Senses of drawn flows."""

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.image.direction import direct_orientation


def flow(size=120):
    """A disc of hair that runs outwards from its middle, and its exact directions."""
    y, x = np.mgrid[:size, :size] + 0.5 - size / 2
    radius = np.hypot(x, y)
    mask = (radius < size / 2) & (radius > 6)
    outwards = np.stack([x, y], axis=-1) / radius[..., None]
    return np.arctan2(outwards[..., 1], outwards[..., 0]) % np.pi, outwards, mask


def test_hair_leads_away_from_its_roots_everywhere():
    angle, outwards, mask = flow()
    ring = 60 + 8 * np.stack([np.cos(np.arange(12)), np.sin(np.arange(12))], axis=1)
    directed = direct_orientation(angle, mask=mask, roots_px=ring, gravity=(0.0, 0.1))
    assert ((directed * outwards).sum(axis=-1)[mask] > 0).mean() > 0.97


def test_the_angle_is_kept_and_nothing_is_given_outside():
    angle, _, mask = flow()
    angle[50:60, 20:30] = np.nan
    directed = direct_orientation(angle, mask=mask)
    given = mask & np.isfinite(angle)
    np.testing.assert_allclose(np.linalg.norm(directed[given], axis=1), 1, atol=1e-6)
    across = directed[..., 0] * np.sin(angle) - directed[..., 1] * np.cos(angle)
    assert np.abs(across[given]).max() < 1e-6
    assert not directed[~given].any()


def test_without_roots_hair_falls():
    mask = np.ones((60, 60), bool)
    directed = direct_orientation(np.full((60, 60), 1.2), mask=mask)
    assert (directed[..., 1] > 0).all()


def test_hair_combed_up_from_its_roots_runs_up():
    mask = np.ones((80, 40), bool)
    roots = np.stack([np.arange(40) + 0.5, np.full(40, 79.5)], axis=1)
    directed = direct_orientation(np.full((80, 40), 1.5), mask=mask, roots_px=roots)
    assert (directed[..., 1] < 0).all()


def test_an_empty_mask_gives_nothing_and_another_shape_is_refused():
    assert not direct_orientation(np.zeros((9, 9)), mask=np.zeros((9, 9), bool)).any()
    with pytest.raises(InputError, match="expected"):
        direct_orientation(np.zeros((9, 9)), mask=np.zeros((8, 9), bool))
