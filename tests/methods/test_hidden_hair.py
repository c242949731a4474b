"""Laws of the hair that the photograph does not show, on a ball whose upper half is scalp."""

import numpy as np
import pytest
from methods.small_head import (
    RADIUS,
    SCALE,
    SIZE,
    ball,
    curves,
    long_alpha,
    small_depths,
    small_hair,
    small_volume,
    solid_pixels,
)
from scipy.spatial import KDTree

from tress.base.report import Report
from tress.methods.portrait.behind_body import behind_shoulders
from tress.methods.portrait.box import Box
from tress.methods.portrait.depth import depth
from tress.methods.portrait.hanging import hanging_edge
from tress.methods.portrait.sweep import swept

SCALP_END = 0.02


@pytest.fixture(scope="module")
def short():
    return small_hair(small_volume(), Report())


@pytest.fixture(scope="module")
def long():
    alpha = long_alpha()
    return small_hair(small_volume(alpha), Report(), alpha=alpha)


def shown_as_skin() -> np.ndarray:
    """(V,) bool: scalp of the ball that faces the camera where the photo shows skin."""
    points = ball().positions_in_view
    column, row = (points[:, :2] * [SCALE, -SCALE] + SIZE / 2).astype(int).T
    return (points[:, 2] > 0) & solid_pixels()[np.clip(row, 0, SIZE - 1), np.clip(column, 0, SIZE - 1)]


def test_scalp_that_does_not_show_bare_has_hair(short):
    head = ball()
    scalp = head.positions_in_view[(head.masks["scalp"] > 0.5) & ~shown_as_skin()]
    assert np.percentile(KDTree(short.points).query(scalp)[0], 97) < 0.006


def test_skin_that_shows_stays_bare(short):
    head = ball()
    well_within = shown_as_skin() & (head.positions_in_view[:, 2] > 0.04) & (head.positions_in_view[:, 1] < 0.025)
    assert KDTree(short.points).query(head.positions_in_view[well_within])[0].min() > 0.003


def test_short_hair_stays_short_behind(short):
    behind = short.points[short.points[:, 2] < 0]
    assert behind[:, 1].min() > SCALP_END - 0.015
    assert np.linalg.norm(behind, axis=1).max() < RADIUS + 0.02


def test_short_hair_thins_out_towards_the_nape(short):
    behind = short.points[short.points[:, 2] < -0.05]
    above = np.linalg.norm(behind, axis=1) - RADIUS
    assert np.percentile(above[behind[:, 1] < SCALP_END + 0.01], 95) < 0.6 * np.percentile(
        above[behind[:, 1] > SCALP_END + 0.04], 95
    )


def test_short_hair_is_the_shorter_the_thinner_it_lies(short):
    steps = np.linalg.norm(np.diff(short.points, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    length = (along[short.offsets[1:] - 1] - along[short.offsets[:-1]])[~short.visible]
    root = short.points[short.offsets[:-1]][~short.visible]
    low, high = ((root[:, 2] < -0.04) & where for where in (root[:, 1] < SCALP_END + 0.012, root[:, 1] > 0.06))
    assert np.percentile(length[low], 90) < 0.03
    assert np.median(length[low]) < 0.8 * np.median(length[high])


def test_the_crown_turns_down_behind_its_top(short):
    behind = short.points[~np.repeat(short.visible, np.diff(short.offsets)) & (np.abs(short.points[:, 0]) < 0.03)]
    highest = [behind[np.abs(behind[:, 2] - z) < 0.005, 1].max() for z in (-0.01, -0.04, -0.07)]
    assert highest[0] - highest[1] > 0.003
    assert highest[1] - highest[2] > 0.010


def test_short_hair_beside_the_face_is_swept_back():
    hair = small_volume()
    wish = swept(
        small_depths().envelope.head.skin,
        hair.inside,
        np.ones(hair.box.columns, np.bool_),
        backward=np.array([0.0, 0.0, -1.0]),
        box=hair.box,
    )
    place = hair.box.centres(hair.inside)
    beside = (place[:, 2] > 0.02) & (np.abs(place[:, 0]) > 0.04) & (place[:, 1] < 0.055)
    assert beside.sum() > 20
    assert (wish[beside, 2] <= 0).all()
    assert np.median(wish[beside, 2]) < -0.3
    far_behind = place[:, 2] < -0.05
    np.testing.assert_allclose(wish[far_behind], np.tile([0.0, -1.0, 0.0], (far_behind.sum(), 1)), atol=1e-9)


def test_hair_that_hangs_falls_straight():
    hair = small_volume()
    skin = small_depths().envelope.head.skin
    none = np.zeros(hair.box.columns, np.bool_)
    wish = swept(skin, hair.inside, none, backward=np.array([0.0, 0.0, -1.0]), box=hair.box)
    np.testing.assert_array_equal(wish, np.tile([0.0, -1.0, 0.0], (len(wish), 1)))


def test_long_hair_hangs_as_low_behind_as_at_the_sides(long):
    behind = long.points[~np.repeat(long.visible, np.diff(long.offsets)) & (long.points[:, 2] < -0.05)]
    assert behind[:, 1].min() == pytest.approx(-0.15, abs=0.025)


def test_long_hair_does_not_end_in_a_straight_cut(long):
    tips = long.points[long.offsets[1:] - 1]
    behind = tips[~long.visible & (tips[:, 2] < 0) & (tips[:, 1] < -0.05), 1]
    assert len(behind) > 100
    assert np.subtract(*np.percentile(behind, [90, 10])) > 0.02


def test_hair_that_meets_a_shoulder_goes_on_behind_it():
    alpha = long_alpha()
    y = (SIZE / 2 - (np.mgrid[:SIZE, :SIZE] + 0.5)[0]) / SCALE
    x = ((np.mgrid[:SIZE, :SIZE] + 0.5)[1] - SIZE / 2) / SCALE
    shoulder = (np.abs(x) > 0.094) & (y < -0.04)
    shown = np.where(shoulder, 0.0, alpha).astype(np.float32)
    depths = depth(curves(), head=ball(), alpha=shown, solid=solid_pixels(shown) | shoulder, report=Report())
    envelope = depths.envelope
    row, column = (int(np.abs(axis - at).argmin()) for axis, at in ((envelope.box.y, -0.08), (envelope.box.x, 0.097)))
    assert not envelope.hair[row, column]
    assert envelope.extended[row, column]
    foremost = behind_shoulders(envelope, envelope.front)[:, column]
    below = np.flatnonzero(np.isfinite(foremost))
    assert len(below) > 10
    assert (np.diff(foremost[below]) < 0).all()


def box() -> Box:
    return Box(np.array([-0.15, 0.15, -0.15]), 0.003, 100, 100, 100)


def test_the_edge_goes_from_the_one_side_to_the_other():
    b = box()
    x, y = np.meshgrid(b.x, b.y)
    hair = (np.abs(x) > 0.08) & (y > np.where(x < 0, -0.05, -0.11))
    edge = hanging_edge(hair, nape=0.0, middle=0.0, box=b)
    assert edge[0] == pytest.approx(-0.05, abs=b.size)
    assert edge[-1] == pytest.approx(-0.11, abs=b.size)
    assert (np.diff(edge) <= 1e-9).all()


def test_what_lies_below_a_break_is_no_hanging_hair():
    b = box()
    x, y = np.meshgrid(b.x, b.y)
    hair = (np.abs(x) > 0.08) & ((y > 0.02) | (y < -0.08))
    assert hanging_edge(hair, nape=0.0, middle=0.0, box=b).min() > 0.0


def test_depths_know_what_the_photo_shows_as_skin():
    envelope = small_depths().envelope
    assert envelope.bare[np.abs(envelope.box.y).argmin(), np.abs(envelope.box.x).argmin()]
    assert not (envelope.bare & envelope.hair).any()
