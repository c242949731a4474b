"""Traced strands of drawn lines: closed forms and laws."""

import os
import subprocess
import sys

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import map_coordinates

from tress.base.errors import InputError
from tress.image.orient import OrientationMap, OrientParams, orientation_map
from tress.image.trace import TraceParams, sampled, traced_strands
from tress.kernel.image import ridge_seeds, trace

SIZE = 96
PAPER = OrientParams(kernel_scale=1.0, rounds=1)


def drawing(curves, *, size=SIZE):
    """Bright lines about 1.5 px wide, anti-aliased, on black; points (x, y) with pixel centres at +0.5."""
    image = np.zeros((size, size), np.uint8)
    for curve in curves:
        points = np.rint((np.asarray(curve) - 0.5) * 256).astype(np.int32)
        cv2.polylines(image, [points], isClosed=False, color=255, thickness=1, lineType=cv2.LINE_AA, shift=8)
    return image.astype(np.float32) / 255


def strands_of(image, *, params=TraceParams(min_length_px=20.0), orient=PAPER):
    """Strands in and near the bright lines: as in hair, the kernels' side lobes are not looked at."""
    mask = cv2.dilate((image > 0.1).astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    found = orientation_map(image, mask=mask, params=orient)
    return traced(found, mask=mask, params=params)


def traced(found, *, mask=None, params=TraceParams(min_length_px=20.0)):
    shape = found.angle.shape
    return traced_strands(
        found,
        mask=np.ones(shape, bool) if mask is None else mask,
        foreground=np.ones((*shape, 3), np.float32),
        alpha=np.ones(shape, np.float32),
        params=params,
    )


def parts(strands):
    return [strands.points[a:b] for a, b in zip(strands.offsets[:-1], strands.offsets[1:], strict=True)]


def longest(strands):
    return max(parts(strands), key=len)


def test_the_defaults_are_the_paper_s():
    params = TraceParams()
    assert (params.high, params.low, params.epsilon) == (0.3, 0.05, 0.2)
    assert (params.health, params.step_px, params.max_bend) == (5, 0.75, np.pi / 6)
    assert (params.min_length_px, params.smoothing_px) == (0.0, 0.0)


@pytest.mark.parametrize("degrees", [0, 10, 37, 45, 80, 90, 135, 170])
def test_a_straight_line_is_followed_to_its_ends(degrees):
    along = np.array([np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))])
    middle = np.full(2, SIZE / 2)
    strand = longest(strands_of(drawing([[middle - 35 * along, middle + 35 * along]])))
    across = (strand - middle) @ [-along[1], along[0]]
    reached = (strand - middle) @ along
    assert np.abs(across[np.abs(reached) < 32]).max() < 0.6
    assert abs(reached.max() - 35) < 5
    assert abs(reached.min() + 35) < 5


def test_a_circle_is_followed_round_once():
    turn = np.linspace(0, 2 * np.pi, 200)
    strand = longest(strands_of(drawing([48 + 28 * np.stack([np.cos(turn), np.sin(turn)], axis=1)])))
    radius = np.linalg.norm(strand - 48, axis=1)
    assert np.abs(radius - 28).max() < 1.0
    length = np.linalg.norm(np.diff(strand, axis=0), axis=1).sum()
    assert 0.9 * 2 * np.pi * 28 < length < 1.3 * 2 * np.pi * 28


def crossing_map(size=SIZE):
    """The map of two crossing lines in closed form: a wide horizontal one on top of a vertical one."""
    y, x = np.mgrid[:size, :size] + 0.5
    middle = size / 2
    over, under = np.exp(-((y - middle) ** 2) / 2), np.exp(-((x - middle) ** 2) / 2)
    on_top = np.abs(y - middle) < 1
    angle = np.where(on_top, 0.0, np.pi / 2).astype(np.float32)
    return OrientationMap(angle, np.where(on_top, over, under).astype(np.float32))


def test_both_strands_of_a_crossing_survive_and_the_lower_one_is_occluded_there():
    strands = traced(crossing_map(), params=TraceParams(min_length_px=40.0))
    spans = [np.ptp(points, axis=0) for points in parts(strands)]
    horizontal = [i for i, span in enumerate(spans) if span[0] > 80 and span[1] < 3]
    vertical = [i for i, span in enumerate(spans) if span[1] > 80 and span[0] < 3]
    assert len(horizontal) == 1
    assert len(vertical) == 1
    over, under = (slice(*strands.offsets[i : i + 2]) for i in (horizontal[0], vertical[0]))
    assert not strands.occluded[over].any()
    hidden = strands.points[under][strands.occluded[under]]
    assert len(hidden) >= 2
    assert np.abs(hidden[:, 1] - SIZE / 2).max() < 4
    assert (strands.confidence[under][strands.occluded[under]] == 0).all()


@pytest.mark.parametrize(("gap", "health", "pieces"), [(3, 5, 1), (3, 2, 2), (6, 5, 2), (6, 6, 2), (6, 8, 1)])
def test_a_gap_is_bridged_by_fewer_uncertain_steps_than_the_health(gap, health, pieces):
    """Bilinear confidence is below w_low over `gap` - 0.9 px: 2 or 3 steps for a gap of 3 px, 6 or 7 for one of 6."""
    y, x = np.mgrid[:40, :SIZE] + 0.5
    ridge = np.where((x > 40) & (x < 40 + gap), 0, np.exp(-((y - 20) ** 2) / 2)).astype(np.float32)
    strands = traced(OrientationMap(np.zeros((40, SIZE), np.float32), ridge), params=TraceParams(health=health))
    assert strands.count == pieces
    assert not strands.occluded.any()


def test_curvature_is_kept_where_nothing_is_seen():
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    radius, turn = np.hypot(x - 48, y - 48), np.arctan2(y - 48, x - 48)
    angle = ((turn + np.pi / 2) % np.pi).astype(np.float32)
    ridge = np.where(np.abs(turn) < 0.15, 0, np.exp(-((radius - 30) ** 2) / 2)).astype(np.float32)
    strand = longest(traced(OrientationMap(angle, ridge), params=TraceParams(health=40)))
    inside = np.abs(np.arctan2(strand[:, 1] - 48, strand[:, 0] - 48)) < 0.15
    assert inside.any()
    assert np.abs(np.linalg.norm(strand[inside] - 48, axis=1) - 30).max() < 1.0


def test_points_lie_on_the_ridge_between_pixels():
    y = np.arange(40)[:, None] + 0.5
    ridge = np.repeat(np.clip(1 - np.abs(y - 20.2) / 3, 0, 1), 60, axis=1).astype(np.float32)
    strand = longest(traced(OrientationMap(np.zeros((40, 60), np.float32), ridge)))
    assert np.abs(strand[3:-3, 1] - 20.2).max() < 0.25


def test_turning_or_mirroring_the_picture_turns_or_mirrors_the_strands():
    image = drawing([[[10, 60], [50, 40], [88, 50]]])
    straight = longest(strands_of(image))
    turned = longest(strands_of(np.rot90(image).copy()))
    back = np.stack([SIZE - turned[:, 1], turned[:, 0]], axis=1)
    mirrored = longest(strands_of(image[:, ::-1].copy())) * [-1, 1] + [SIZE, 0]
    for other in (back, mirrored):
        assert hausdorff(straight, other) < 1.0


def hausdorff(a, b):
    distance = np.linalg.norm(a[:, None] - b[None], axis=2)
    return max(distance.min(axis=0).max(), distance.min(axis=1).max())


def test_one_line_gives_one_strand():
    image = drawing([[[10, 48], [86, 48]]])
    strands = strands_of(image)
    near = [part for part in parts(strands) if np.abs(part[:, 1] - 48).max() < 1.5]
    assert len(near) == 1


def test_a_constant_picture_gives_nothing():
    strands = strands_of(np.full((50, 50), 0.4, np.float32))
    assert strands.count == 0
    assert strands.points.shape == (0, 2)
    assert strands.color.shape == (0, 3)


def test_seeds_are_ridge_pixels_strongest_first():
    y, x = np.mgrid[:20, :30] + 0.0
    confidence = (np.exp(-((y - 9) ** 2)) * (0.4 + x / 60)).astype(np.float32)
    seeds = ridge_seeds(np.zeros((20, 30)), confidence=confidence, high=0.3, epsilon=0.2, reach_px=1.0)
    assert (seeds[:, 0] == 9).all()
    assert seeds[:, 1].tolist() == list(range(29, -1, -1))


def test_seeds_are_those_of_equation_4():
    rng = np.random.default_rng(4)
    confidence = rng.random((30, 40)).astype(np.float32)
    angle = rng.uniform(0, np.pi, confidence.shape).astype(np.float32)
    y, x = np.mgrid[:30, :40]
    across = 1.3 * np.stack([np.cos(angle), -np.sin(angle)])
    left, right = (
        map_coordinates(confidence, [y + sign * across[0], x + sign * across[1]], order=1, mode="nearest")
        for sign in (-1, 1)
    )
    expected = (confidence > 0.3) & (confidence - np.maximum(left, right) > 0.2 * confidence)
    found = np.zeros(confidence.shape, bool)
    found[tuple(ridge_seeds(angle, confidence=confidence, high=0.3, epsilon=0.2, reach_px=1.3).T)] = True
    assert 20 < expected.sum() < 600
    np.testing.assert_array_equal(found, expected)


def test_sampling_is_exact_for_linear_pictures_and_repeats_the_border():
    y, x = np.mgrid[:7, :9] + 0.5
    picture = np.stack([2 * x + 3 * y, -x], axis=-1)
    points = np.array([[0.5, 0.5], [3.25, 4.75], [8.5, 6.5], [-5.0, 3.0]])
    inside = np.clip(points, [0.5, 0.5], [8.5, 6.5])
    expected = np.stack([2 * inside[:, 0] + 3 * inside[:, 1], -inside[:, 0]], axis=1)
    np.testing.assert_allclose(sampled(picture, points=points), expected, rtol=1e-6)


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 12), st.integers(1, 12), st.integers(0, 2**32), st.floats(0, 1))
def test_any_map_gives_strands_inside_the_mask(height, width, seed, unknown):
    rng = np.random.default_rng(seed)
    angle = rng.uniform(0, np.pi, (height, width)).astype(np.float32)
    angle[rng.random(angle.shape) < unknown] = np.nan
    mask = rng.random(angle.shape) < 0.8
    curves = trace(
        angle,
        confidence=rng.random(angle.shape),
        mask=mask,
        high=0.1,
        low=0.05,
        epsilon=0.0,
        health=5,
        step_px=0.75,
        max_bend=0.5,
        reach_px=1.0,
        min_length_px=0.0,
        smoothing_px=1.0,
    )
    assert np.isfinite(curves.points).all()
    assert (np.diff(curves.offsets) >= 2).all()
    assert not curves.occluded[curves.offsets[:-1]].any()
    assert not curves.occluded[curves.offsets[1:] - 1].any()
    assert curves.offsets[-1] == len(curves.points) == len(curves.occluded) == len(curves.confidence)
    assert ((curves.points >= -1) & (curves.points <= [width + 1, height + 1])).all()


def test_the_number_of_threads_does_not_matter():
    code = (
        "import numpy as np, hashlib; from tress.image.orient import orientation_map;"
        "from tress.image.trace import traced_strands;"
        "i = np.random.default_rng(1).random((90, 90)); m = np.ones((90, 90), bool); o = orientation_map(i, mask=m);"
        "t = traced_strands(o, mask=m, foreground=np.zeros((90, 90, 3), np.float32), alpha=m.astype(np.float32));"
        "print(t.count, hashlib.sha256(o.angle.tobytes() + t.points.tobytes() + t.offsets.tobytes()).hexdigest())"
    )
    runs = [
        subprocess.run(
            [sys.executable, "-c", code], env={**os.environ, "RAYON_NUM_THREADS": n}, capture_output=True, check=True
        ).stdout
        for n in ("1", "4")
    ]
    assert runs[0] == runs[1]
    assert int(runs[0].split()[0]) > 0


def test_hostile_maps_are_refused():
    ones = np.ones((5, 5), np.float32)
    with pytest.raises(InputError, match="mask"):
        traced_strands(
            OrientationMap(ones.copy(), ones.copy()),
            mask=np.ones((4, 5), bool),
            foreground=np.ones((5, 5, 3), np.float32),
            alpha=ones,
        )
    with pytest.raises(InputError, match="finite"):
        ridge_seeds(ones, confidence=ones * np.nan, high=0.3, epsilon=0.2, reach_px=1.0)
