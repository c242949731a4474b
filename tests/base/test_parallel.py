"""Parts side by side: the same results in the same order, and errors come through."""

import threading

import numpy as np
import pytest

from tress.base.parallel import each, in_bands, together


def test_results_keep_the_order_of_the_items() -> None:
    assert each(lambda n: n * n, range(100)) == [n * n for n in range(100)]


def test_two_functions_run_at_the_same_time() -> None:
    meeting = threading.Barrier(2, timeout=10)
    assert sorted(together(meeting.wait, meeting.wait)) == [0, 1]


@pytest.mark.parametrize("failing", [0, 1])
def test_an_error_of_either_comes_through(failing: int) -> None:
    tasks = [lambda: 1, lambda: 1]
    tasks[failing] = lambda: 1 // 0
    with pytest.raises(ZeroDivisionError):
        together(*tasks)


@pytest.mark.parametrize("height", [0, 1, 48, 49, 500])
def test_bands_give_the_bits_of_the_whole(height: int) -> None:
    random = np.random.default_rng(height)
    a, b = random.normal(size=(height, 7, 3)), random.normal(size=(height, 7, 1))
    product, mean = in_bands(lambda a, b: (a * b, a.mean(axis=2)), a, b)
    assert np.array_equal(product, a * b) and np.array_equal(mean, a.mean(axis=2))
