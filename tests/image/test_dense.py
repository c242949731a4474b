"""Dense orientation: exact on straight stripes, turns with the picture, fills flat gaps, ignores noise."""

import numpy as np
import pytest

from tress.image.dense import dense_orientation


def stripes(angle: float, size: int = 160, wavelength_px: float = 6.0) -> np.ndarray:
    """Stripes that run along `angle`, y down."""
    y, x = np.mgrid[:size, :size] + 0.5
    return (0.5 + 0.3 * np.cos(2 * np.pi * (y * np.cos(angle) - x * np.sin(angle)) / wavelength_px)).astype(np.float32)


def apart(a: np.ndarray, b: np.ndarray | float) -> np.ndarray:
    """Angle between undirected angles, degrees."""
    difference = np.abs(a - b) % np.pi
    return np.degrees(np.minimum(difference, np.pi - difference))


@pytest.mark.parametrize("degrees", [0, 17, 45, 90, 133])
def test_stripes_give_their_own_direction(degrees):
    angle = np.radians(degrees)
    mask = np.zeros((160, 160), bool)
    mask[20:140, 20:140] = True
    found = dense_orientation(stripes(angle), mask=mask)
    assert apart(found.angle[mask], angle).max() < 3
    assert found.coherence[mask].mean() > 0.5
    assert np.isnan(found.angle[~mask]).all()


def test_a_quarter_turn_of_the_picture_turns_the_angles():
    rng = np.random.default_rng(3)
    image = stripes(0.4) + 0.1 * rng.random((160, 160), np.float32)
    mask = np.ones((160, 160), bool)
    turned = dense_orientation(np.rot90(image).copy(), mask=mask)
    straight = dense_orientation(image, mask=mask)
    error = apart(np.rot90(turned.angle, -1), (straight.angle - np.pi / 2) % np.pi)
    assert np.median(error[20:-20, 20:-20]) < 1


def test_noise_is_averaged_away():
    rng = np.random.default_rng(0)
    image = stripes(1.0) + rng.normal(0, 0.3, (160, 160)).astype(np.float32)
    found = dense_orientation(image, mask=np.ones((160, 160), bool))
    assert np.median(apart(found.angle[20:-20, 20:-20], 1.0)) < 5


def test_a_flat_gap_takes_the_direction_around_it():
    image = stripes(0.7)
    image[60:90, 60:90] = 0.5
    found = dense_orientation(image, mask=np.ones((160, 160), bool))
    assert apart(found.angle[60:90, 60:90], 0.7).max() < 12


def test_an_empty_mask_gives_nothing():
    found = dense_orientation(stripes(0.0), mask=np.zeros((160, 160), bool))
    assert np.isnan(found.angle).all() and not found.coherence.any()
