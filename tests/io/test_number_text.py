"""Numbers as text: each gives back its float32, and whole numbers are those that Python writes."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tress.io.number_text import batches, decimals, flagged, shares, text_of_rows, whole_numbers

QUICK = settings(max_examples=300, deadline=None)
BORDERS = [value * sign for value in (2.0**-6, 2.0**-13, 1, 10, 100, 9.9999995) for sign in (1, -1)]


def read(values: np.ndarray) -> np.ndarray:
    """The numbers written and read again."""
    return np.array(text_of_rows(decimals(values), "\n").split(), np.float64).astype(np.float32).reshape(values.shape)


@QUICK
@given(st.lists(st.floats(width=32, allow_nan=False, allow_infinity=False), min_size=1))
def test_any_float_comes_back_to_the_bit(numbers):
    values = np.float32(numbers)[:, None] + np.float32(0)  # no negative zero
    assert read(values).tobytes() == values.tobytes()


def test_the_floats_about_every_border_come_back_to_the_bit():
    steps = np.arange(-2000, 2000, dtype=np.int32)
    around = np.concatenate([(np.float32(border).view(np.int32) + steps).view(np.float32) for border in BORDERS])
    assert read(around.reshape(-1, 3)).tobytes() == around.tobytes()


def test_floats_all_over_the_head_come_back_to_the_bit():
    exponents = np.random.default_rng(0).uniform(-12, 4, (50_000, 3))
    values = (10**exponents * np.sign(exponents)).astype(np.float32)
    assert read(values).tobytes() == values.tobytes()


@QUICK
@given(st.lists(st.one_of(st.integers(0, 10**12), st.integers(0, 10**5)), min_size=1))
def test_whole_numbers_are_those_of_python(numbers):
    assert text_of_rows(whole_numbers(np.array(numbers)), " ").decode().split() == [str(number) for number in numbers]


def test_shares_are_those_of_python():
    values = np.random.default_rng(0).random((500, 3))
    assert text_of_rows(shares(values)) == "".join(f" {value:.4f}" for value in values.ravel()).encode()


def test_flags_choose_rows():
    numbers = whole_numbers(np.arange(3))
    assert text_of_rows(flagged(np.array([True, False, True]), "line "), numbers, ";") == b"line 0;1;line 2;"


def test_batches_cover_all_rows_once():
    assert np.concatenate([np.arange(40_000)[rows] for rows in batches(40_000)]).tolist() == list(range(40_000))
    assert batches(0) == []
