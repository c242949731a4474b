"""The two-label cut against every division of a small graph, mixtures, reach, the guided filter."""

import itertools

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.image.cut import two_label_cut
from tress.image.guided_filter import guided_filter
from tress.image.mixture import fitted_mixture, log_density
from tress.image.reach import reach


def energy(label: np.ndarray, cost: np.ndarray, edges: np.ndarray, weight: np.ndarray) -> float:
    parted = label[edges[:, 0]] != label[edges[:, 1]]
    return float(cost[np.arange(len(label)), label.astype(int)].sum() + weight[parted].sum())


@pytest.mark.parametrize("seed", range(8))
def test_the_cut_is_the_cheapest_of_all_divisions(seed: int) -> None:
    random = np.random.default_rng(seed)
    count = 9
    edges = np.array([e for e in itertools.combinations(range(count), 2) if random.random() < 0.4], np.int32)
    cost, weight = random.uniform(0, 3, (count, 2)), random.uniform(0, 2, len(edges))
    best = min(energy(np.array(bits), cost, edges, weight) for bits in itertools.product([False, True], repeat=count))
    label = two_label_cut(cost, edges=edges, weight=weight)
    assert energy(label, cost, edges, weight) == pytest.approx(best, abs=0.03)


def test_edges_that_do_not_fit_are_refused() -> None:
    with pytest.raises(InputError, match="do not fit"):
        two_label_cut(np.ones((2, 2)), edges=np.array([[0, 2]], np.int32), weight=np.ones(1))


def test_a_mixture_finds_two_clusters_and_integrates_to_one() -> None:
    random = np.random.default_rng(1)
    samples = np.concatenate([random.normal(-4, 1, (3000, 1)), random.normal(5, 0.5, (1000, 1))])
    mixture = fitted_mixture(samples, weights=np.ones(4000), count=2, floor=np.array([1e-6]), iterations=20)
    order = np.argsort(mixture.mean[:, 0])
    assert mixture.mean[order, 0] == pytest.approx([-4, 5], abs=0.1)
    assert mixture.weight[order] == pytest.approx([0.75, 0.25], abs=0.02)
    axis = np.linspace(-12, 12, 4001)[:, None]
    assert np.exp(log_density(mixture, axis)).sum() * 24 / 4000 == pytest.approx(1, abs=1e-3)


def test_samples_of_no_weight_do_not_matter() -> None:
    random = np.random.default_rng(2)
    samples = random.normal(size=(50, 2))
    more = np.concatenate([samples, random.normal(50, 1, (20, 2))])
    floor = np.full(2, 1e-3)
    alone = fitted_mixture(samples, weights=np.ones(50), count=1, floor=floor)
    with_rest = fitted_mixture(more, weights=np.repeat([1.0, 0.0], [50, 20]), count=1, floor=floor)
    assert with_rest.mean == pytest.approx(alone.mean)
    assert with_rest.covariance == pytest.approx(alone.covariance)


def test_reach_goes_round_what_is_dear() -> None:
    toll = np.array([0.0, 9.0, 9.0, 1.0, 1.0, 1.0])
    edges = np.array([[0, 1], [1, 2], [0, 3], [3, 4], [4, 2]], np.int32)
    way = reach(toll, edges=edges, start=np.arange(6) == 0)
    assert way[:5] == pytest.approx([0, 9, 11, 1, 2], abs=1e-6)
    assert np.isinf(way[5])
    assert np.isinf(reach(toll, edges=edges, start=np.zeros(6, bool))).all()


def test_a_guided_filter_keeps_constants_sums_and_the_guide_s_edges() -> None:
    guide = np.zeros((40, 40, 3), np.uint8)
    guide[:, 21:] = (200, 120, 40)
    rough = np.zeros((40, 40, 2), np.float32)
    rough[:, 19:, 0] = 1
    rough[..., 1] = 1 - rough[..., 0]
    smooth = guided_filter(rough, guide=guide, radius=5)
    assert smooth.sum(axis=-1) == pytest.approx(1, abs=1e-3)
    assert (smooth[:, 20, 0] < 0.5).all() and (smooth[:, 21, 0] > 0.5).all(), "the border moves onto the guide's edge"
    constant = np.full((40, 40, 1), 0.3, np.float32)
    assert guided_filter(constant, guide=guide, radius=5) == pytest.approx(0.3, abs=1e-4)
