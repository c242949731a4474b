"""Laws of depth, volume and strands on a ball with a cap of hair."""

import numpy as np
import pytest
from methods.small_head import RADIUS, SCALE, SIZE, ball, curves, small_depths, small_hair, small_volume

from tress.base.errors import InputError
from tress.base.report import Report
from tress.kernel import geom


@pytest.fixture(scope="module")
def cap():
    return small_volume()


@pytest.fixture(scope="module")
def grown(cap):
    report = Report()
    with report.stage("strands"):
        hair = small_hair(cap, report)
    return hair, report.stages[0].numbers


def test_front_mid_and_back_lie_in_their_order(cap):
    seen = np.isfinite(cap.front)
    assert seen.sum() > 300
    assert (cap.front[seen] >= cap.mid[seen] - 1e-6).all()
    everywhere = np.isfinite(cap.back)
    assert (cap.mid[everywhere] >= cap.back[everywhere] - 1e-6).all()


def test_the_front_lies_before_the_head_and_near_it(cap):
    box = cap.box
    x, y = np.meshgrid(box.x, box.y)
    inner = np.isfinite(cap.front) & (np.hypot(x, y) < 0.8 * RADIUS)
    surface = np.sqrt(np.maximum(RADIUS**2 - x**2 - y**2, 0))
    gap = (cap.front - surface)[inner]
    assert gap.min() > 0.001
    assert gap.max() < 0.03


def test_the_back_covers_the_rear_of_the_head(cap):
    box = cap.box
    x, y = np.meshgrid(box.x, box.y)
    above_nape = (np.hypot(x, y) < 0.9 * RADIUS) & (y > 0.03)
    assert (cap.back < -np.sqrt(np.maximum(RADIUS**2 - x**2 - y**2, 0)))[above_nape].all()


def test_directions_are_unit_inside_and_zero_outside(cap):
    length = np.linalg.norm(cap.direction, axis=-1)
    assert np.allclose(length[cap.inside], 1, atol=1e-4)
    assert not length[~cap.inside].any()


def test_hidden_hair_stays_behind_the_silhouette(grown):
    hair, _ = grown
    pixel = hair.points[:, :2] * [SCALE, -SCALE] + SIZE / 2
    outside = np.hypot(*(pixel - SIZE / 2).T) > (RADIUS + 0.012) * SCALE + 4
    assert outside.mean() < 1e-3


def test_strands_through_the_head_are_counted(grown):
    hair, numbers = grown
    head = ball()
    near = np.nonzero(np.linalg.norm(hair.points, axis=1) < RADIUS + 0.002)[0]
    distance = geom.signed_distances(
        head.positions_in_view, triangles=head.triangles, queries=hair.points[near].astype(np.float64)
    ).distance
    through = np.unique(np.searchsorted(hair.offsets, near[distance < -0.0015], side="right"))
    assert len(through) <= numbers["strands_through_head"] <= 0.02 * (len(hair.offsets) - 1)


def test_the_same_seed_gives_the_same_strands(cap, grown):
    again = small_hair(cap, Report())
    assert again.points.tobytes() == grown[0].points.tobytes()
    assert again.color.tobytes() == grown[0].color.tobytes()
    assert small_hair(cap, Report(), seed=1).points.tobytes() != again.points.tobytes()


def test_both_visible_and_hidden_strands_grow(grown):
    hair, numbers = grown
    assert 50 < hair.visible.sum() < len(hair.visible)
    assert (np.diff(hair.offsets) >= 2).all()
    assert numbers["vertices"] == len(hair.points) == hair.offsets[-1]


def test_depth_strokes_move_the_strands_under_them():
    strokes = np.full((SIZE, SIZE), np.nan, np.float32)
    strokes[:, :100] = 0.2
    points = curves().points
    moved = small_depths(strokes).z - small_depths().z
    assert np.abs(small_depths(strokes).z[points[:, 0] < 90] - 0.2).max() < 0.02
    assert np.abs(moved[points[:, 0] > 130]).max() < 0.02


def test_the_depth_converges_and_says_so():
    report = Report()
    with report.stage("depth"):
        found = small_depths(report=report)
    assert found.converged
    assert report.stages[0].numbers["converged"] is True
    assert len(found.z) == len(curves().points)


def test_strokes_of_another_size_are_refused():
    with pytest.raises(InputError):
        small_depths(np.zeros((3, 3), np.float32))
