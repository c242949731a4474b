"""Hidden hair is completed from what is seen: one colour stays one colour, and nothing but hair lends colour."""

import numpy as np

from tress.methods.portrait.strand_colors import _completed

SHAPE = (90, 120)


def ring_of_hair() -> np.ndarray:
    """(H, W) bool: hair around a face."""
    rows, columns = np.indices(SHAPE)
    distance = np.hypot(rows - 45, columns - 60)
    return (distance > 18) & (distance < 40)


def everywhere() -> np.ndarray:
    """(N, 2): places of hidden strands all over the ring and within it."""
    rows, columns = np.nonzero(np.hypot(*(np.indices(SHAPE) - np.array([45, 60])[:, None, None])) < 40)
    return np.stack([columns, rows], axis=-1) + 0.5


def test_hair_of_one_colour_is_completed_in_it():
    hair = ring_of_hair()
    picture = np.where(hair[..., None], np.float32([0.3, 0.2, 0.1]), np.float32([0.0, 1.0, 0.0])).astype(np.float32)
    filled = _completed(picture, hair, everywhere(), seed=0)
    inside = everywhere().astype(int)
    np.testing.assert_allclose(filled[inside[:, 1], inside[:, 0]], [[0.3, 0.2, 0.1]] * len(inside), atol=1e-4)


def test_the_completion_keeps_to_the_range_of_the_hair_and_to_its_seed():
    hair = ring_of_hair()
    picture = np.random.default_rng(1).uniform(0.2, 0.6, (*SHAPE, 3)).astype(np.float32)
    picture[~hair] = 5.0
    filled = _completed(picture, hair, everywhere(), seed=7)
    inside = everywhere().astype(int)
    values = filled[inside[:, 1], inside[:, 0]]
    assert values.min() >= 0.19 and values.max() <= 0.61
    assert np.array_equal(filled, _completed(picture, hair, everywhere(), seed=7))


def test_too_little_hair_gives_its_mean():
    hair = np.zeros(SHAPE, bool)
    hair[10, 10:14] = True
    picture = np.zeros((*SHAPE, 3), np.float32)
    picture[hair] = [0.4, 0.3, 0.2]
    filled = _completed(picture, hair, everywhere(), seed=0)
    np.testing.assert_allclose(filled[45, 60], [0.4, 0.3, 0.2], atol=1e-6)
