"""The smooth colour of the skin against a direct solver and its laws."""

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import spsolve

from tress.head.skin_field import FAR_M, NEAR_M, skin_field, surface
from tress.head.statistical import load_statistical_head

HEAD = load_statistical_head()
SKIN = np.arange(len(HEAD.mean)) < HEAD.skin_count


def some_trust(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    trust = HEAD.masks["face"] * (rng.random(len(HEAD.mean)) < 0.7)
    return rng.random((len(HEAD.mean), 3)), trust


def test_it_is_what_a_direct_solver_finds() -> None:
    known, trust = some_trust(1)
    far = np.array([0.8, 0.5, 0.4])
    laplacian, area = surface(HEAD)
    hold, screen = area * trust / NEAR_M**2, area / FAR_M**2
    exact = spsolve(csc_array(laplacian + diags_array(hold + screen)), hold[:, None] * known + screen[:, None] * far)
    assert skin_field(known, trust=trust, far=far, head=HEAD) == pytest.approx(exact, abs=2e-3)


def test_one_colour_stays_that_colour_exactly() -> None:
    color = np.array([0.3, 0.6, 0.2])
    _, trust = some_trust(2)
    known = np.broadcast_to(color, (len(HEAD.mean), 3))
    assert np.array_equal(
        skin_field(known, trust=trust, far=color, head=HEAD), np.broadcast_to(color.astype(np.float32), known.shape)
    )


def test_no_colour_leaves_the_range_of_what_is_known() -> None:
    known, trust = some_trust(3)
    field = skin_field(known, trust=trust, far=np.full(3, 0.5), head=HEAD)
    assert field.min() > -2e-3 and field.max() < 1 + 2e-3


def test_nothing_known_gives_the_far_colour() -> None:
    far = np.array([0.8, 0.5, 0.4])
    field = skin_field(np.zeros((len(HEAD.mean), 3)), trust=np.zeros(len(HEAD.mean)), far=far, head=HEAD)
    assert field == pytest.approx(np.broadcast_to(far, field.shape))


def test_what_is_known_fades_with_the_distance_towards_the_far_colour() -> None:
    nose = np.linalg.norm(HEAD.mean - HEAD.mean[np.argmax(HEAD.mean[:, 2])], axis=1)
    trust = (nose < 0.02).astype(float)
    field = skin_field(np.ones((len(HEAD.mean), 3)), trust=trust, far=np.zeros(3), head=HEAD)[:, 0]
    rings = [field[SKIN & (nose > low) & (nose <= low + 0.02)].mean() for low in np.arange(0, 0.2, 0.02)]
    assert rings[0] > 0.9 and rings[-1] < 0.05
    assert (np.diff(rings) < 0).all()
