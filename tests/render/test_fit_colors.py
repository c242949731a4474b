"""Analysis by synthesis: a random groom takes the colours of a picture."""

from dataclasses import replace

import numpy as np
import pytest
from render.small_scene import drawn, fringe, wall
from scipy.ndimage import gaussian_filter

from tress.base.errors import InputError
from tress.kernel.raster import SEGMENT
from tress.render.fit_colors import fit_vertex_colors
from tress.render.gbuffer import hair_coverage
from tress.render.picture import premultiplied_rgba, straight_rgba
from tress.render.styles.photo import PhotoStyle

TARGET = np.stack([gaussian_filter(np.random.default_rng(i).uniform(0, 1, (60, 80)), 1.5) for i in range(3)], axis=-1)
TARGET = ((TARGET - TARGET.min()) / np.ptp(TARGET)).astype(np.float32)


def rendered(gbuffer, colors):
    picture = premultiplied_rgba(
        replace(gbuffer, scene=replace(gbuffer.scene, color=colors)), style=PhotoStyle(), hold_out_meshes=True
    )
    return straight_rgba(picture)[..., :3], picture[..., 3]


def test_a_random_groom_reproduces_a_picture():
    gbuffer = drawn([fringe(radius=5e-4, points=60, alpha=0.8)])
    weight = np.ones((60, 80))
    colors = fit_vertex_colors(gbuffer, colors=gbuffer.scene.color, target_linear=TARGET, weight=weight, iterations=20)
    picture, coverage = rendered(gbuffer, colors)
    error = (picture - TARGET)[coverage > 0]
    assert 10 * np.log10(1 / np.mean(error**2)) > 35


def test_one_colour_everywhere_is_found_at_once():
    gbuffer = drawn([fringe()])
    target = np.broadcast_to(np.float32([0.2, 0.3, 0.4]), (60, 80, 3))
    colors = fit_vertex_colors(
        gbuffer, colors=np.zeros_like(gbuffer.scene.color), target_linear=target, weight=np.ones((60, 80)), iterations=1
    )
    assert np.allclose(rendered(gbuffer, colors)[0], target, atol=1e-3)


def test_points_that_do_not_show_keep_their_colours():
    gbuffer = drawn([fringe(count=20, depth=0.02), fringe(count=20, seed=1, depth=-0.1)], [wall()])
    start = gbuffer.scene.color
    colors = fit_vertex_colors(gbuffer, colors=start, target_linear=TARGET, weight=np.ones((60, 80)))
    assert np.array_equal(colors[240:], start[240:])
    assert not np.array_equal(colors[:240], start[:240])


def test_points_without_freedom_keep_their_colours_and_the_others_make_up_for_them():
    gbuffer = drawn([fringe(radius=5e-4, points=60, alpha=0.8)])
    start, weight = gbuffer.scene.color, np.ones((60, 80))
    free = (np.arange(len(start)) % 120 < 60).astype(np.float32)
    colors = fit_vertex_colors(gbuffer, colors=start, target_linear=TARGET, weight=weight, freedom=free)
    assert np.array_equal(colors[free == 0], start[free == 0])
    before, after = (np.abs(rendered(gbuffer, c)[0] - TARGET).mean() for c in (start, colors))
    assert after < 0.8 * before


def test_pixels_without_weight_say_nothing():
    gbuffer = drawn([fringe()])
    target = np.where(np.arange(80)[None, :, None] < 40, TARGET, np.nan).astype(np.float32)
    weight = np.zeros((60, 80))
    weight[:, :40] = 1
    colors = fit_vertex_colors(gbuffer, colors=gbuffer.scene.color, target_linear=target, weight=weight)
    right = gbuffer.scene.points[:, 0] > 0.02
    assert np.isfinite(colors).all()
    assert np.array_equal(colors[right], gbuffer.scene.color[right])


def test_colours_stay_in_range():
    gbuffer = drawn([fringe()])
    colors = fit_vertex_colors(
        gbuffer, colors=gbuffer.scene.color, target_linear=TARGET * 9 - 4, weight=np.ones((60, 80)), most=1.2
    )
    assert colors.min() >= 0
    assert colors.max() <= np.float32(1.2)


def test_wrong_shapes_are_refused():
    gbuffer = drawn([fringe()])
    with pytest.raises(InputError, match=r"weight has shape \(3, 3\)"):
        fit_vertex_colors(gbuffer, colors=gbuffer.scene.color, target_linear=TARGET, weight=np.ones((3, 3)))


def handed_back(fragments, *, residual, pixel_weight, points):
    """Every point's mean (points, 3) of the pixels that it shows in, fragment by fragment."""
    pixel = np.repeat(np.arange(pixel_weight.size), np.diff(fragments.pixel_offsets))
    hair = fragments.kind == SEGMENT
    first, t = fragments.primitive[hair], fragments.parameter[hair, 0]
    share = (fragments.weight * pixel_weight.ravel()[pixel])[hair]
    total, shown = np.zeros((points, 3)), np.zeros(points)
    for point, part in ((first, 1 - t), (first + 1, t)):
        np.add.at(total, point, (share * part)[:, None] * residual.reshape(-1, 3)[pixel[hair]])
        np.add.at(shown, point, share * part)
    return total / np.maximum(shown, 1e-12)[:, None]


def test_one_round_hands_back_the_mean_error():
    """The first round is the transpose of shading."""
    gbuffer = drawn([fringe(alpha=0.6)])
    start = np.full_like(gbuffer.scene.color, 0.5)
    weight = np.random.default_rng(5).uniform(0.1, 1, (60, 80)).astype(np.float32)
    fitted = fit_vertex_colors(gbuffer, colors=start, target_linear=TARGET, weight=weight, iterations=1, most=10)
    residual = np.where(hair_coverage(gbuffer)[..., None] > 0, TARGET - 0.5, 0)
    mean = handed_back(gbuffer.fragments, residual=residual, pixel_weight=weight, points=len(start))
    np.testing.assert_allclose(fitted, np.clip(start + mean, 0, 10), atol=1e-5)
