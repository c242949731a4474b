"""The matte against a dense solve of the same Laplacian, against PyMatting, and on composites of known alpha."""

import os
import subprocess
import sys

import cv2
import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from tress.base.errors import InputError
from tress.image.color import linear_to_srgb8, srgb_to_linear
from tress.image.matte import MatteParams, matte_of_mask
from tress.image.near_colors import near_colors
from tress.image.trimap import trimap_of_mask
from tress.image.unmix import unmixed
from tress.kernel.matting import closed_form_alpha


def scene(side: int = 64, seed: int = 0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Image (H, W, 3) in [0, 1], true alpha and trimap: a soft disk with hairs before a striped backdrop."""
    random = np.random.default_rng(seed)
    rows, columns = np.indices((side, side)) / side - 0.5
    alpha = np.clip((0.3 - np.hypot(rows, columns)) / 0.1 + 0.5, 0, 1)
    for angle in np.linspace(0, 2 * np.pi, 24, endpoint=False):
        along = rows * np.sin(angle) + columns * np.cos(angle)
        across = columns * np.sin(angle) - rows * np.cos(angle)
        alpha = np.maximum(alpha, 0.6 * np.exp(-((across * side) ** 2)) * (along > 0) * (along < 0.4))
    front = np.array([0.45, 0.25, 0.12]) + 0.03 * random.normal(size=(side, side, 1))
    back = np.array([0.5, 0.7, 0.85]) + 0.1 * np.sin(12 * columns)[..., None]
    distance = np.hypot(rows, columns)
    trimap = np.full((side, side), 128, np.uint8)
    trimap[distance < 0.22] = 255
    trimap[distance > 0.42] = 0
    alpha[trimap == 0] = 0
    return np.clip(alpha[..., None] * front + (1 - alpha[..., None]) * back, 0, 1), alpha, trimap


def alpha_by_spsolve(image: np.ndarray, trimap: np.ndarray, epsilon: float) -> np.ndarray:
    """Closed-form alpha by building the whole matting Laplacian, window by window, and a direct solve."""
    height, width = trimap.shape
    number = np.arange(height * width).reshape(height, width)
    flat = image.reshape(-1, 3)
    rows, columns, values = [], [], []
    for y in range(1, height - 1):
        for x in range(1, width - 1):
            window = number[y - 1 : y + 2, x - 1 : x + 2].ravel()
            away = flat[window] - flat[window].mean(axis=0)
            inverse = np.linalg.inv(away.T @ away / 9 + epsilon / 9 * np.eye(3))
            rows.append(np.repeat(window, 9))
            columns.append(np.tile(window, 9))
            values.append((np.eye(9) - (1 + away @ inverse @ away.T) / 9).ravel())
    parts = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    laplacian = coo_matrix(parts, shape=(height * width,) * 2).tocsc()
    unknown = np.flatnonzero((trimap != 0).ravel() & (trimap != 255).ravel())
    alpha = (trimap == 255).ravel().astype(float)
    known = np.setdiff1d(number.ravel(), unknown)
    alpha[unknown] = spsolve(laplacian[unknown][:, unknown], -laplacian[unknown][:, known] @ alpha[known])
    return np.clip(alpha, 0, 1).reshape(height, width)


@pytest.mark.parametrize("epsilon", [1e-5, 1e-3])
def test_alpha_is_that_of_a_direct_solve(epsilon: float) -> None:
    image, _, trimap = scene(48)
    solved = closed_form_alpha(image, trimap=trimap, epsilon=epsilon, tolerance=1e-9)
    assert solved.converged
    expected = alpha_by_spsolve(image.astype(np.float32).astype(float), trimap, epsilon)
    assert np.abs(solved.alpha - expected).max() < 1e-3


def test_alpha_is_near_the_truth_and_never_far_from_the_known() -> None:
    image, truth, trimap = scene(128)
    solved = closed_form_alpha(image, trimap=trimap)
    assert np.abs(solved.alpha - truth)[trimap == 128].mean() < 0.05
    assert (solved.alpha[trimap == 255] == 1).all() and (solved.alpha[trimap == 0] == 0).all()


def test_alpha_turns_with_the_picture() -> None:
    image, _, trimap = scene(64)
    upright = closed_form_alpha(image, trimap=trimap, tolerance=1e-8).alpha
    turned = closed_form_alpha(np.rot90(image), trimap=np.rot90(trimap), tolerance=1e-8).alpha
    assert np.rot90(turned, -1) == pytest.approx(upright, abs=5e-3)


@pytest.mark.slow
def test_alpha_is_that_of_pymatting() -> None:
    pymatting = pytest.importorskip("pymatting")
    image, _, trimap = scene(96)
    image = image.astype(np.float32).astype(float)
    reference = pymatting.estimate_alpha_cf(image, trimap / 255 * (trimap != 128) + 0.5 * (trimap == 128))
    ours = closed_form_alpha(image, trimap=trimap, epsilon=1e-7, tolerance=1e-8).alpha
    assert np.abs(ours - reference).mean() < 2e-3


def test_settling_changes_alpha_little() -> None:
    image, truth, trimap = scene(256)
    exact = closed_form_alpha(image, trimap=trimap).alpha
    settled = closed_form_alpha(image, trimap=trimap, settle=0.02).alpha
    assert np.abs(settled - exact)[trimap == 128].mean() < 0.01
    assert np.abs(settled - truth)[trimap == 128].mean() < np.abs(exact - truth)[trimap == 128].mean() + 0.002
    assert ((settled == 0) & (trimap == 128)).sum() > ((exact == 0) & (trimap == 128)).sum(), "some were settled"


def test_near_colours_are_those_of_the_nearest_known() -> None:
    image = np.zeros((64, 96, 3), np.float32)
    image[:, :48], image[:, 48:] = (0.2, 0.4, 0.6), (0.8, 0.1, 0.3)
    weight = np.zeros((64, 96), np.float32)
    weight[:, :12], weight[:, 84:] = 1, 1
    near = near_colors(image, weight=weight)
    assert near.mean[:, :8] == pytest.approx(np.broadcast_to((0.2, 0.4, 0.6), (64, 8, 3)), abs=0.02)
    assert near.mean[:, 88:] == pytest.approx(np.broadcast_to((0.8, 0.1, 0.3), (64, 8, 3)), abs=0.02)
    assert (near.mean[:, 20, 0] < 0.4).all() and (near.mean[:, 78, 0] > 0.6).all()
    assert (near.variance >= 0).all() and near.variance[:, :6].max() < 0.01 < near.variance[:, 48].max()
    assert (near_colors(image, weight=np.zeros_like(weight)).mean == 0).all()


def test_flat_colours_are_unmixed_and_a_wrong_alpha_mended() -> None:
    columns = np.broadcast_to(np.arange(120), (40, 120))
    alpha = np.clip((80 - columns) / 40, 0, 1).astype(np.float32)
    front, back = np.array([0.05, 0.03, 0.02]), np.array([0.3, 0.7, 0.4])
    light = (alpha[..., None] * front + (1 - alpha[..., None]) * back).astype(np.float32)
    hazy = np.where((alpha > 0) & (alpha < 1), 0.8 * alpha + 0.1, alpha).astype(np.float32)
    parts = unmixed(light, alpha=hazy)
    assert np.abs(parts.alpha - alpha).max() < 0.02
    assert np.abs(parts.foreground - front)[alpha > 0.05].max() < 0.02
    assert np.abs(parts.background - back)[alpha < 0.95].max() < 0.02


def test_what_is_solid_or_free_stays_so() -> None:
    light = np.random.default_rng(0).random((40, 50, 3), np.float32)
    solid = unmixed(light, alpha=np.ones((40, 50), np.float32))
    assert solid.foreground == pytest.approx(light, abs=1e-6) and (solid.alpha == 1).all()
    free = unmixed(light, alpha=np.zeros((40, 50), np.float32))
    assert free.background == pytest.approx(light, abs=1e-6) and (free.alpha == 0).all()


def test_soft_hair_takes_no_colour_from_the_backdrop() -> None:
    """Thin dark lines, drawn at four times the size, mixed with a bright backdrop in linear light."""
    random, side = np.random.default_rng(4), 160
    drawn = np.zeros((4 * side, 4 * side), np.uint8)
    drawn[: 2 * side] = 255
    for _ in range(160):
        x, lean = random.uniform(0, 4 * side), random.normal(0, 40)
        ends = [(round(x), 2 * side - 9), (round(x + lean), 2 * side + round(random.uniform(20, 120)))]
        cv2.line(drawn, *ends, 255, int(random.integers(2, 6)))
    alpha = cv2.resize(drawn, (side, side), interpolation=cv2.INTER_AREA)[..., None] / 255
    front = np.array([0.06, 0.04, 0.03]) * (1 + 0.5 * np.sin(np.arange(side) / 3))[None, :, None]
    for back in ((0.8, 0.8, 0.8), (0.3, 0.75, 0.1), (0.6, 0.35, 0.25)):
        image = linear_to_srgb8(alpha * front + (1 - alpha) * np.array(back))
        matte = matte_of_mask(image, mask=np.indices((side, side))[0] < 0.55 * side, head_height_px=400)
        soft = (alpha[..., 0] > 0.05) & (alpha[..., 0] < 0.9) & (matte.alpha > 0.05)
        error = (matte.foreground - front)[soft]
        towards = np.array(back) - np.broadcast_to(front, image.shape)[soft]
        leak = np.abs((error * towards).sum(axis=1) / (towards**2).sum(axis=1)).mean()
        assert soft.sum() > 300 and leak < 0.06, (back, leak)


def test_a_trimap_is_a_band_of_the_given_widths() -> None:
    mask = np.zeros((60, 80), bool)
    mask[:, 30:] = True
    row = trimap_of_mask(mask, shrink_px=5, grow_px=8)[30]
    assert np.flatnonzero(row == 128).tolist() == list(range(22, 35))
    assert (row[:22] == 0).all() and (row[35:] == 255).all()
    assert (trimap_of_mask(np.ones((4, 4), bool), shrink_px=9, grow_px=9) == 255).all()
    assert (trimap_of_mask(np.zeros((4, 4), bool), shrink_px=9, grow_px=9) == 0).all()


def composite(side: int = 200) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """sRGB photograph of soft dark hair before a bright backdrop, mixed in linear light; alpha, colour, rough mask."""
    rows, columns = np.indices((side, side)) / side
    border = 0.5 + 0.04 * np.sin(40 * rows)
    alpha = np.clip((border - columns) / 0.06 + 0.5, 0, 1)
    front = np.array([0.08, 0.04, 0.02]) * (1 + 0.3 * np.sin(90 * columns + 20 * rows))[..., None]
    back = np.array([0.3, 0.75, 0.35]) * np.ones((side, side, 1))
    mixed = alpha[..., None] * front + (1 - alpha[..., None]) * back
    coded = np.where(mixed <= 0.0031308, 12.92 * mixed, 1.055 * mixed ** (1 / 2.4) - 0.055)
    return np.rint(255 * coded).astype(np.uint8), alpha, front, columns < 0.5


def test_the_matte_of_a_composite_gives_back_its_parts() -> None:
    image, alpha, front, mask = composite()
    matte = matte_of_mask(image, mask=mask, head_height_px=360)
    band = matte.trimap == 128
    assert matte.converged and band.mean() > 0.05
    assert np.abs(matte.alpha - alpha)[band].mean() < 0.1
    hairy = band & (alpha > 0.3)
    assert np.abs(matte.foreground - front)[hairy].mean() < 0.04, "no halo: the backdrop is ten times as bright"
    assert (matte.foreground[hairy][:, 1] < 0.35).all(), "no halo anywhere"


def test_the_parts_of_a_matte_make_up_the_photograph() -> None:
    image, _, _, mask = composite()
    matte = matte_of_mask(image, mask=mask, head_height_px=220)
    light = srgb_to_linear(image)
    mixed = matte.alpha[..., None] * matte.foreground + (1 - matte.alpha[..., None]) * matte.background
    error_sq = np.square(mixed - light)[matte.trimap == 128].mean()
    assert 10 * np.log10(1 / error_sq) > 45
    assert np.abs(mixed - light)[matte.trimap != 128].max() < 0.02


def test_strokes_beside_the_mask_stay_free() -> None:
    image, _, _, mask = composite()
    free = np.zeros_like(mask)
    free[:, 101:110] = True
    matte = matte_of_mask(image, mask=mask, head_height_px=220, known_background=free)
    assert (matte.alpha[free] == 0).all()


def test_an_empty_mask_gives_an_empty_matte() -> None:
    image, _, _, mask = composite(40)
    matte = matte_of_mask(image, mask=np.zeros_like(mask), head_height_px=30)
    assert (matte.alpha == 0).all() and matte.converged
    assert matte.background == pytest.approx(srgb_to_linear(image))


def test_a_sharp_step_is_kept_sharp() -> None:
    image = np.zeros((80, 80, 3), np.uint8)
    image[:, 41:] = 230
    mask = np.zeros((80, 80), bool)
    mask[:, 44:] = True
    alpha = matte_of_mask(image, mask=mask, head_height_px=200).alpha
    assert (alpha[:, :41] < 0.05).all() and (alpha[:, 41:] > 0.95).all()


PROGRAM = """
import numpy as np, sys, hashlib
from tress.kernel.matting import closed_form_alpha
image = np.random.default_rng(3).random((150, 400, 3), np.float32)
image = (image + np.linspace(0, 2, 400, dtype=np.float32)[:, None]) / 3
trimap = np.full((150, 400), 128, np.uint8); trimap[:, :9] = 0; trimap[:, -9:] = 255
alpha = closed_form_alpha(image, trimap=trimap, max_iterations=20, settle=0.02).alpha
print(hashlib.sha256(alpha.tobytes()).hexdigest())
"""


def test_the_number_of_threads_does_not_change_a_bit() -> None:
    hashes = {
        subprocess.run(
            [sys.executable, "-c", PROGRAM],
            env={**os.environ, "RAYON_NUM_THREADS": threads},
            capture_output=True,
            check=True,
        ).stdout
        for threads in ("1", "3")
    }
    assert len(hashes) == 1


def test_bad_input_is_refused() -> None:
    image = np.zeros((8, 8, 3))
    with pytest.raises(InputError, match="trimap"):
        closed_form_alpha(image, trimap=np.zeros((8, 9), np.uint8))
    with pytest.raises(InputError, match="no known pixel"):
        closed_form_alpha(image, trimap=np.full((8, 8), 128, np.uint8))
    with pytest.raises(InputError, match="too small"):
        closed_form_alpha(image[:2], trimap=np.zeros((2, 8), np.uint8))
    with pytest.raises(InputError, match="finite"):
        closed_form_alpha(image * np.nan, trimap=np.zeros((8, 8), np.uint8))
    with pytest.raises(InputError, match="0 px high"):
        matte_of_mask(image.astype(np.uint8), mask=np.ones((8, 8), bool), head_height_px=0)
    with pytest.raises(InputError, match="mask"):
        matte_of_mask(image.astype(np.uint8), mask=np.ones((8, 9), bool), head_height_px=5)
    assert MatteParams().shrink == pytest.approx(0.035)


def test_a_picture_without_unknowns_is_its_trimap() -> None:
    trimap = np.zeros((20, 20), np.uint8)
    cv2.circle(trimap, (10, 10), 5, 255, -1)
    solved = closed_form_alpha(np.full((20, 20, 3), 0.5), trimap=trimap)
    assert np.array_equal(solved.alpha, (trimap == 255).astype(np.float32)) and solved.iterations == 0
