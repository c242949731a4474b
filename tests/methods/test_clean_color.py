"""The colour of hair without its rim."""

import numpy as np

from tress.methods.portrait.clean_color import RIM, clean_color, hair_core

PX_PER_METRE = 1000.0


def stripe() -> tuple[np.ndarray, np.ndarray]:
    """Dark hair with a teal rim as wide as what is not trusted, and where it is."""
    solid = np.zeros((60, 80), bool)
    solid[10:50, 20:60] = True
    color = np.full((60, 80, 3), 0.5, np.float32)
    color[solid] = [0.0, 0.3, 0.3]
    rim = round(RIM * PX_PER_METRE)
    color[10 + rim : 50 - rim, 20 + rim : 60 - rim] = [0.02, 0.01, 0.01]
    return color, solid


def test_the_rim_takes_the_colour_of_the_middle():
    color, solid = stripe()
    assert np.allclose(clean_color(color, solid, px_per_metre=PX_PER_METRE), [0.02, 0.01, 0.01], atol=2e-3)


def test_the_middle_stays_as_it_is():
    color, solid = stripe()
    color += np.random.default_rng(0).uniform(0, 0.1, color.shape).astype(np.float32)
    core = hair_core(solid, px_per_metre=PX_PER_METRE)
    assert np.array_equal(clean_color(color, solid, px_per_metre=PX_PER_METRE)[core], color[core])


def test_thin_hair_keeps_some_core():
    solid = np.zeros((40, 40), bool)
    solid[:, 18:21] = True
    core = hair_core(solid, px_per_metre=PX_PER_METRE)
    assert core.any()
    assert not (core & ~solid).any()


def test_no_hair_changes_nothing():
    color, solid = stripe()
    assert np.array_equal(clean_color(color, np.zeros_like(solid), px_per_metre=PX_PER_METRE), color)
