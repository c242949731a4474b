"""Strand operations against NumPy and closed forms."""

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.kernel import strands

RNG = np.random.default_rng(0)
OFFSETS = np.cumsum([0, *RNG.integers(2, 30, 50)])
POINTS = np.cumsum(RNG.normal(0, 0.01, (OFFSETS[-1], 3)), axis=0)


def each(values):
    return np.split(values, OFFSETS[1:-1])


def test_lengths_are_sums_of_steps():
    expected = [np.linalg.norm(np.diff(p, axis=0), axis=1).sum() for p in each(POINTS)]
    assert np.allclose(strands.lengths(POINTS, offsets=OFFSETS), expected)
    arcs = each(strands.arc_lengths(POINTS, offsets=OFFSETS))
    assert all(a[0] == 0 for a in arcs)
    assert np.allclose([a[-1] for a in arcs], expected)


def test_resampling_is_numpys_interpolation_over_arc_length():
    sampling = strands.resample_by_count(POINTS, offsets=OFFSETS, count=17)
    assert sampling.offsets.tolist() == list(range(0, 17 * 51, 17))
    found = sampling.values(POINTS).reshape(50, 17, 3)
    for points, arc, new in zip(each(POINTS), each(strands.arc_lengths(POINTS, offsets=OFFSETS)), found, strict=True):
        at = np.linspace(0, arc[-1], 17)
        expected = np.stack([np.interp(at, arc, points[:, k]) for k in range(3)], axis=1)
        assert np.allclose(new, expected, atol=1e-12)


def test_resampling_twice_to_the_same_count_changes_little_of_a_straight_strand():
    line = np.outer(np.array([0, 0.1, 0.5, 2.0]), [1.0, 2, 3])
    once = strands.resample_by_count(line, offsets=[0, 4], count=9).values(line)
    twice = strands.resample_by_count(once, offsets=[0, 9], count=9).values(once)
    assert np.allclose(once, twice, atol=1e-12)


def test_attributes_keep_their_dtype_and_whole_numbers_are_not_mixed():
    sampling = strands.resample_by_spacing(POINTS, offsets=OFFSETS, spacing=0.005)
    color = RNG.uniform(0, 1, (len(POINTS), 3)).astype(np.float32)
    label = RNG.integers(0, 3, len(POINTS)) * 10
    assert sampling.values(color).dtype == np.float32
    assert set(sampling.values(label)) <= {0, 10, 20}
    assert np.array_equal(sampling.values(color)[sampling.offsets[:-1]], color[OFFSETS[:-1]])


def test_smoothing_shortens_and_keeps_ends():
    found = strands.smooth(POINTS, offsets=OFFSETS, amount=3.0)
    ends = np.concatenate([OFFSETS[:-1], OFFSETS[1:] - 1])
    assert np.array_equal(found[ends], POINTS[ends])
    before = strands.lengths(POINTS, offsets=OFFSETS)
    assert (strands.lengths(found, offsets=OFFSETS) <= before + 1e-12).all()
    assert np.array_equal(strands.smooth(POINTS, offsets=OFFSETS, amount=0), POINTS)


def test_rotations_keep_lengths():
    matrix = np.eye(4)
    matrix[:3, :3] = np.linalg.qr(RNG.normal(size=(3, 3)))[0]
    matrix[:3, 3] = [1, 2, 3]
    moved = strands.transformed(POINTS, transform=matrix)
    lengths = strands.lengths(POINTS, offsets=OFFSETS)
    assert np.allclose(strands.lengths(moved, offsets=OFFSETS), lengths, atol=1e-5)  # points are single precision
    assert np.allclose(moved, POINTS @ matrix[:3, :3].T + matrix[:3, 3], atol=1e-6)
    assert np.allclose(strands.transformed([[0, 0, 0]], transform=matrix), [[1, 2, 3]])


@pytest.mark.parametrize(
    ("offsets", "message"),
    [([0, 3], "0 to 4 was expected"), ([0, 3, 4], "strand 1 has 1 points"), ([1, 4], "run from 1")],
)
def test_wrong_offsets_are_refused(offsets, message):
    with pytest.raises(InputError, match=message):
        strands.lengths(np.zeros((4, 3)), offsets=offsets)


def test_wrong_settings_are_refused():
    points = np.zeros((4, 3))
    with pytest.raises(InputError, match="count is 1"):
        strands.resample_by_count(points, offsets=[0, 4], count=1)
    with pytest.raises(InputError, match="spacing is 0"):
        strands.resample_by_spacing(points, offsets=[0, 4], spacing=0)
    with pytest.raises(InputError, match="amount is nan"):
        strands.smooth(points, offsets=[0, 4], amount=float("nan"))
