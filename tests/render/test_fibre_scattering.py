"""Physics of the fibre: energy, reciprocity, symmetry around and along."""

import numpy as np
import pytest

from tress.render.fibre_scattering import Fibre, scattering

ALONG = np.array([0.0, 0.0, 1.0])


def direction(theta, phi):
    return np.stack([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), np.sin(theta)], axis=-1)


def scattered(to_light, to_eye, color=(1.0, 1.0, 1.0), fibre=None):
    count = max(len(np.atleast_2d(to_light)), len(np.atleast_2d(to_eye)))
    tile = np.broadcast_to
    return scattering(
        tile(ALONG, (count, 3)),
        to_light=to_light,
        to_eye=to_eye,
        color=tile(np.array(color), (count, 3)),
        fibre=fibre or Fibre(),
    )


def sphere(count=400):
    """Directions and their solid angles."""
    theta = (np.arange(count) + 0.5) / count * np.pi - np.pi / 2
    phi = (np.arange(count) + 0.5) / count * 2 * np.pi
    theta, phi = np.meshgrid(theta, phi)
    area = np.cos(theta) * (np.pi / count) * (2 * np.pi / count)
    return direction(theta.ravel(), phi.ravel()), area.ravel()


@pytest.mark.parametrize("theta", [0.0, 0.4, -0.9, 1.2])
def test_no_more_energy_leaves_than_arrives(theta):
    directions, area = sphere()
    cosine = np.sqrt(1 - directions[:, 2] ** 2)
    returned = (scattered(direction(theta, 0.3), directions)[:, 0] * cosine * area).sum()
    assert returned <= 1 + 1e-3
    if abs(theta) < 0.5:
        assert returned >= 0.9, "white hair keeps little"


def test_darker_hair_returns_less_in_every_direction():
    directions, _ = sphere(60)
    bright = scattered(direction(0.2, 0), directions, (0.8, 0.5, 0.2))
    dark = scattered(direction(0.2, 0), directions, (0.4, 0.25, 0.1))
    assert (dark <= bright).all()
    black = scattered(direction(0.2, 0), directions, (0.0, 0.0, 0.0))
    assert (np.ptp(black, axis=1) == 0).all(), "the surface highlight has no colour"
    assert black.max() > 0


def test_light_and_eye_may_change_places():
    rng = np.random.default_rng(0)
    a, b = (direction(rng.uniform(-1.3, 1.3, 200), rng.uniform(0, 6.3, 200)) for _ in range(2))
    assert np.allclose(scattered(a, b, (0.6, 0.4, 0.2)), scattered(b, a, (0.6, 0.4, 0.2)), rtol=1e-4)


def test_it_is_symmetric_around_the_fibre():
    light = direction(0.3, 0.0)
    left, right = direction(-0.1, 0.8), direction(-0.1, -0.8)
    assert np.allclose(scattered(light, left), scattered(light, right), rtol=1e-5)
    turned = scattered(direction(0.3, 1.1), direction(-0.1, 1.9))
    assert np.allclose(turned, scattered(light, left), rtol=1e-5)


def test_the_cuticle_shifts_the_highlight_towards_the_root():
    angles = np.linspace(-1, 1, 801)
    eye = direction(angles, np.zeros_like(angles))
    black = (0.0, 0.0, 0.0)
    straight = angles[scattered(direction(0.0, 0.0), eye, black, Fibre(tilt_rad=0.0))[:, 0].argmax()]
    tilted = angles[scattered(direction(0.0, 0.0), eye, black, Fibre(tilt_rad=0.05))[:, 0].argmax()]
    assert straight == pytest.approx(0, abs=0.01)
    assert tilted == pytest.approx(-0.1, abs=0.03)
