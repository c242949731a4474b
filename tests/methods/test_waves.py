"""Waves: measured in a picture's flow, and put on hidden hair."""

import numpy as np
import pytest

from tress.methods.portrait.flow import HairFlow
from tress.methods.portrait.waves import NOISE, WILDEST, waves, waviness

PX_PER_METRE = 1000.0


def winding(amount: float) -> HairFlow:
    """Hair that runs down and winds by up to `amount` radians, every 12 mm."""
    y = np.mgrid[:200, :200][0]
    angle = np.pi / 2 + amount * np.sin(2 * np.pi * y / 12)
    direction = np.stack([np.cos(angle), np.sin(angle)], axis=-1).astype(np.float32)
    return HairFlow(direction, np.ones((200, 200), np.float32))


def test_straight_hair_has_no_waves():
    assert waviness(winding(0.0), px_per_metre=PX_PER_METRE) == 0.0


@pytest.mark.parametrize("amount", [0.3, 0.6])
def test_waves_are_as_strong_as_they_wind(amount):
    assert waviness(winding(amount), px_per_metre=PX_PER_METRE) == pytest.approx(amount / np.sqrt(2) - NOISE, abs=0.03)


def test_waves_have_an_end_and_empty_flows_none():
    assert waviness(winding(1.5), px_per_metre=PX_PER_METRE) <= WILDEST
    empty = HairFlow(np.zeros((20, 20, 2), np.float32), np.zeros((20, 20), np.float32))
    assert waviness(empty, px_per_metre=PX_PER_METRE) == 0.0


def test_the_field_of_waves_is_smooth_and_the_same_again():
    places = np.random.default_rng(0).uniform(0, 40, (5000, 3))
    field = waves(places, shape=(40, 40, 40), lock=4.0, seed=3)
    near = waves(places + 0.1, shape=(40, 40, 40), lock=4.0, seed=3)
    assert np.array_equal(field, waves(places, shape=(40, 40, 40), lock=4.0, seed=3))
    assert np.linalg.norm(near - field, axis=1).max() < 0.5
    assert 0.3 < field.std() < 1.1
    assert np.abs(field.mean(axis=0)).max() < 0.1
