"""Outlines: as wide as asked at any size of picture, at borders that stand apart, and nowhere else."""

import numpy as np
import pytest
from render.toon_scene import ball, flat, seen, strips

from tress.render.outline import OutlineParams, outlines


def lines(*meshes, size=256, **settings):
    """(H, W) opacity of the lines."""
    return outlines(seen(*meshes, size=size), params=OutlineParams(**{"least_px": 0.0, **settings}))[..., 3]


@pytest.mark.parametrize("size", [128, 384])
@pytest.mark.parametrize("width", [1.0, 2.0, 5.0])
def test_a_line_is_as_wide_as_asked_at_any_size(size, width):
    """Opacities add up to the width across a straight border, around a disc to the width times its length."""
    straight = lines(strips(flat()), size=size, width_px=width)[size // 2, : size // 2]
    assert straight.sum() == pytest.approx(width, abs=0.05)
    around = lines(ball(), size=size, width_px=width).sum() / (2 * np.pi * 0.1 * size / 0.32)
    assert around == pytest.approx(width, rel=0.12)


def test_width_0_draws_nothing():
    assert lines(ball(), width_px=0.0).max() == 0


def test_a_ball_has_no_line_inside():
    found = lines(ball(), width_px=2.0)
    y, x = np.mgrid[:256, :256] + 0.5
    radius = np.hypot(x - 128, y - 128)
    assert found[radius < 80 - 3].max() == 0 and found[radius > 80 + 3].max() == 0
    assert found[np.abs(radius - 80) < 0.5].min() > 0.4


@pytest.mark.parametrize(("gap", "melds"), [(0.002, True), (0.015, False)])
def test_clumps_that_lie_on_one_another_meld(gap, melds):
    upper, lower = flat(left=-0.05, right=0.0, z=gap), flat(left=-0.02, right=0.05)
    across = lines(strips(upper, lower), width_px=2.0)[128, 100:156]
    assert across.sum() == pytest.approx(0.0 if melds else 2.0, abs=0.1)
    if not melds:
        assert abs(100 + np.average(np.arange(56) + 0.5, weights=across) - 128) < 1


def test_the_threshold_of_the_step_is_that_of_the_setting():
    upper, lower = flat(left=-0.05, right=0.0, z=0.01), flat(left=-0.02, right=0.05)
    found = [lines(strips(upper, lower), step_m=step)[128, 100:156].max() for step in (0.009, 0.011)]
    assert found[0] == 1 and found[1] == 0


def test_a_surface_seen_nearly_edge_on_makes_no_lines():
    """A strip turned by 85 degrees changes its depth by 11 px from each pixel to the next."""
    points = flat(left=-0.15, right=0.15)
    turned = points.copy()
    turned[..., 0], turned[..., 2] = points[..., 0] * np.cos(1.48), points[..., 0] * np.sin(1.48)
    found = lines(strips(turned), width_px=1.0)
    columns = np.flatnonzero(found[128])
    assert columns.max() - columns.min() < 26 and found[128, 126:131].max() == 0


@pytest.mark.parametrize(("angle", "line"), [(0.6, False), (1.6, True)])
def test_creases_are_lines_where_they_turn_enough(angle, line):
    """A roof of two flats that meet at x = 0, each turned away by half the angle."""
    points = flat()
    points[..., 2] = -np.abs(points[..., 0]) * np.tan(angle / 2)
    middle = lines(strips(points), width_px=2.0, crease_rad=1.2)[128, 120:136]
    assert (middle.max() > 0.9) == line


def test_meshes_of_other_colors_have_a_line_where_they_touch():
    skin, hair = ball(color=(0.5, 0.3, 0.2)), strips(flat(left=-0.02, right=0.02, z=0.1005), color=(0.05, 0.02, 0.01))
    alike = strips(flat(left=-0.02, right=0.02, z=0.1005), color=(0.5, 0.3, 0.2))
    assert lines(skin, hair)[128, 106:118].max() == 1 and lines(skin, alike)[128, 106:118].max() == 0


def test_short_lines_are_left_out():
    upper = flat(left=-0.005, right=0.005, top=0.005, bottom=-0.005, z=0.02)
    kept, gone = (lines(strips(upper, flat()), least_px=least)[110:146, 110:146].max() for least in (4.0, 16.0))
    assert kept == 1 and gone == 0


def test_ink_is_a_part_of_the_color_beside_the_line():
    found = outlines(seen(ball(color=(0.5, 0.25, 0.125)), size=128), params=OutlineParams(width_px=3.0, ink=0.2))
    solid = found[found[..., 3] == 1][:, :3]
    assert len(solid) > 100
    np.testing.assert_allclose(solid, np.tile([0.1, 0.05, 0.025], (len(solid), 1)), atol=1e-6)


def test_lines_lie_beyond_the_silhouette_too_with_their_own_opacity():
    found = outlines(seen(ball(), size=128), params=OutlineParams(width_px=4.0))
    y, x = np.mgrid[:128, :128] + 0.5
    beyond = np.hypot(x - 64, y - 64) > 40.8
    assert found[beyond, 3].max() > 0.8
    assert (found[..., :3].max(axis=-1) <= found[..., 3] + 1e-6).all()
