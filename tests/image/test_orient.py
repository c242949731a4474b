"""Orientation of drawn stripes and lines against closed forms."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tress.base.errors import InputError
from tress.image.orient import OrientParams, brightness, orientation_map
from tress.kernel.image import GaborSizes, gabor_responses, orient

ONE_ROUND = OrientParams(rounds=0, kernel_scale=1.0, angles="between")


def stripes(angle, *, size=48, wavelength=4.0):
    """Cosine stripes that run along `angle` with a crest through the middle pixel."""
    y, x = np.mgrid[:size, :size] - size // 2
    return np.cos(2 * np.pi / wavelength * (y * np.cos(angle) - x * np.sin(angle)))


def undirected_degrees(a, b):
    apart = np.abs(a - b) % np.pi
    return np.rad2deg(np.minimum(apart, np.pi - apart))


def test_the_defaults_are_the_paper_s():
    params = OrientParams()
    sizes = (params.sigma_u, params.sigma_v, params.wavelength, params.orientations)
    assert sizes == (1.8, 2.4, 4.0, 32)
    assert params.rounds in (1, 2)
    assert (params.stretch, params.polarity, params.angles, params.negatives) == (1.0, "bright", "bins", "counted")


@given(st.floats(0, 3.14159))
def test_crests_run_along_the_stripes(angle):
    found = orientation_map(stripes(angle), mask=np.ones((48, 48), bool), params=ONE_ROUND)
    assert undirected_degrees(found.angle[24, 24], angle) < 0.2


def test_angles_on_the_bins_are_multiples_of_their_distance():
    params = OrientParams(rounds=0, kernel_scale=1.0)
    found = orientation_map(stripes(0.3), mask=np.ones((48, 48), bool), params=params)
    bins = found.angle / (np.pi / 32)
    np.testing.assert_allclose(bins, np.rint(bins), atol=1e-4)


def test_kernels_have_zero_mean_and_unit_norm():
    impulse = np.zeros((41, 41))
    impulse[20, 20] = 1
    kernels = gabor_responses(impulse)
    np.testing.assert_allclose(kernels.sum(axis=(1, 2)), 0, atol=1e-6)
    np.testing.assert_allclose((kernels**2).sum(axis=(1, 2)), 1, atol=1e-5)


def test_a_constant_picture_has_no_confidence():
    found = orientation_map(np.full((30, 30), 0.7), mask=np.ones((30, 30), bool))
    assert not found.confidence.any()


def test_outside_the_mask_nothing_is_given():
    mask = np.zeros((48, 48), bool)
    mask[10:30, 10:30] = True
    found = orientation_map(stripes(1.0), mask=mask, params=OrientParams(margin_px=0))
    assert np.isnan(found.angle[~mask]).all()
    assert np.isfinite(found.angle[mask]).all()
    assert not found.confidence[~mask].any()


def test_a_shape_that_does_not_fit_and_nan_are_refused():
    with pytest.raises(InputError, match="mask"):
        orient(np.zeros((4, 5)), mask=np.ones((5, 4), bool))
    with pytest.raises(InputError, match="finite"):
        orient(np.full((4, 5), np.nan), mask=np.ones((4, 5), bool))


@pytest.mark.parametrize("sizes", [GaborSizes(), GaborSizes(sigma_v=7.2), GaborSizes(0.7, 0.5, 2.1)])
@pytest.mark.parametrize("orientations", [4, 6, 32])
def test_the_folded_bank_answers_like_plain_correlation(sizes, orientations):
    image = np.random.default_rng(0).random((37, 53)).astype(np.float32)
    answers = gabor_responses(image, sizes=sizes, orientations=orientations)
    for k, answer in enumerate(answers):
        kernel = gabor_kernel(np.pi * k / orientations, sizes)
        plain = cv2.filter2D(image.astype(np.float64), cv2.CV_64F, kernel, borderType=cv2.BORDER_REPLICATE)
        np.testing.assert_allclose(answer, plain, atol=2e-6)


def gabor_kernel(theta, sizes):
    """Eq. 2 of the paper on a disc, its mean removed under the bell, of unit norm."""
    radius = int(np.ceil(2.5 * max(sizes.sigma_u, sizes.sigma_v)))
    v, u = np.mgrid[-radius : radius + 1, -radius : radius + 1]
    across, along = u * np.cos(theta) + v * np.sin(theta), -u * np.sin(theta) + v * np.cos(theta)
    bell = np.exp(-0.5 * ((across / sizes.sigma_u) ** 2 + (along / sizes.sigma_v) ** 2)) * (u**2 + v**2 <= radius**2)
    wave = bell * np.cos(2 * np.pi * across / sizes.wavelength)
    kernel = wave - bell * wave.sum() / bell.sum()
    return kernel / np.linalg.norm(kernel)


def test_confidence_is_that_of_equation_3():
    image = np.random.default_rng(1).random((24, 31)).astype(np.float32)
    answers = gabor_responses(image).astype(np.float64)
    angle, confidence = orient(image, mask=np.ones(image.shape, bool), between_bins=False)
    best = answers.argmax(axis=0)
    apart = np.abs(np.arange(32)[:, None, None] - best)
    distance = np.minimum(apart, 32 - apart) * np.pi / 32
    expected = np.sqrt((distance * (answers - answers.max(axis=0)) ** 2).sum(axis=0))
    np.testing.assert_allclose(confidence, expected, rtol=1e-4)
    np.testing.assert_allclose(angle, (best * np.pi / 32 + np.pi / 2) % np.pi, atol=1e-5)


def test_of_several_banks_each_pixel_takes_the_strongest_answer():
    image = np.random.default_rng(2).random((20, 22)).astype(np.float32)
    mask = np.ones(image.shape, bool)
    banks = [GaborSizes(), GaborSizes(sigma_v=4.8)]
    (first, _), (second, _) = (orient(image, mask=mask, sizes=[bank]) for bank in banks)
    both, _ = orient(image, mask=mask, sizes=banks)
    stronger = gabor_responses(image, sizes=banks[1]).max(axis=0) > gabor_responses(image, sizes=banks[0]).max(axis=0)
    np.testing.assert_array_equal(both, np.where(stronger, second, first))


def test_valleys_beside_a_line_get_no_confidence():
    image = np.zeros((41, 41), np.float32)
    image[:, 20] = 1
    mask = np.ones(image.shape, bool)
    (_, counted), (_, ignored) = (orient(image, mask=mask, ridges_only=only) for only in (False, True))
    assert ignored[20, 18] < 0.1 * ignored[20, 20]
    assert counted[20, 18] > 2 * ignored[20, 18]
    assert ignored[20, 20] > 0.5 * counted[20, 20]


def test_dark_strands_are_found_where_asked_for():
    image = 1 - stripes(0.4)
    for polarity in ("dark", "both"):
        params = OrientParams(rounds=0, kernel_scale=1.0, angles="between", polarity=polarity)
        found = orientation_map(image, mask=np.ones(image.shape, bool), params=params)
        assert undirected_degrees(found.angle[24, 24], 0.4) < 0.2


@settings(max_examples=30, deadline=None)
@given(st.integers(1, 20), st.integers(1, 20), st.integers(0, 2**32))
def test_any_picture_and_mask_give_angles_in_range(height, width, seed):
    rng = np.random.default_rng(seed)
    image, mask = rng.normal(size=(height, width)), rng.random((height, width)) < 0.5
    found = orientation_map(image, mask=mask, params=OrientParams(margin_px=1))
    known = np.isfinite(found.angle)
    assert known[mask].all()
    assert ((found.angle[known] >= 0) & (found.angle[known] < np.float32(np.pi))).all()
    assert ((found.confidence >= 0) & (found.confidence <= 1)).all()
    assert not found.confidence[~known].any()


@pytest.mark.parametrize("sizes", [GaborSizes(0.0), GaborSizes(float("nan")), GaborSizes(wavelength=1e9)])
def test_sizes_without_sense_are_refused(sizes):
    with pytest.raises(InputError, match="Gabor"):
        gabor_responses(np.zeros((4, 4)), sizes=sizes)


def test_an_odd_number_of_orientations_is_refused():
    with pytest.raises(InputError, match="even"):
        gabor_responses(np.zeros((4, 4)), orientations=7)


@pytest.mark.parametrize("case", ["straight", "ponytail", "ponytail_yaw20"])
def test_confident_angles_are_those_of_the_rendered_strands(open_data, case):
    truth = np.load(open_data(f"synthetic/{case}/truth.npz"))
    pixels = cv2.imread(str(open_data(f"synthetic/{case}/photo.png")))[..., ::-1].copy()
    mask = truth["hair_mask"] > 127
    found = orientation_map(brightness(pixels), mask=mask, params=OrientParams.robust())
    confident = mask & (found.confidence > 0.3) & np.isfinite(truth["orientation"])
    assert confident.sum() > 0.1 * mask.sum()
    assert np.median(undirected_degrees(found.angle, truth["orientation"])[confident]) < 10
