"""Colours: linear blending, straight and premultiplied, textures, the laws that every style keeps."""

import numpy as np
import pytest
from render.small_scene import drawn, fringe, wall

from tress.base.color import linear_to_srgb8, srgb_to_linear
from tress.model.strands import Strands
from tress.model.texture import Texture
from tress.render.mesh_color import bilinear
from tress.render.picture import over, premultiplied_rgba, srgb_rgb, srgb_rgba, straight_rgba
from tress.render.styles import STYLES
from tress.render.styles.photo import PhotoStyle

QUAD_UV = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]], np.float32)


def plain(strands, color):
    count = len(strands.points)
    attributes = dict(strands.point_attributes) | {"color": np.tile(np.float32(color), (count, 1))}
    return Strands(points=strands.points, offsets=strands.offsets, point_attributes=attributes)


def test_half_opaque_white_over_black_is_half_in_linear_light():
    hair = plain(fringe(count=60, radius=1.67e-3 / 2, alpha=0.5), (1, 1, 1))
    picture = over(premultiplied_rgba(drawn([hair]), style=PhotoStyle()), background=(0, 0, 0))
    coverage = premultiplied_rgba(drawn([hair]), style=PhotoStyle())[..., 3]
    assert np.allclose(picture, coverage[..., None])
    assert linear_to_srgb8(np.array([0.5]))[0] == 188


def test_straight_and_premultiplied_tell_the_same():
    picture = premultiplied_rgba(drawn([fringe(count=30)]), style=PhotoStyle())
    straight = straight_rgba(picture)
    assert np.allclose(straight[..., :3] * straight[..., 3:], picture[..., :3], atol=1e-6)
    assert straight[picture[..., 3] == 0].max() == 0


def test_files_have_srgb_colour_and_linear_alpha():
    hair = plain(fringe(count=60, alpha=0.5), (0.2, 0.4, 0.6))
    picture = premultiplied_rgba(drawn([hair]), style=PhotoStyle())
    pixels = srgb_rgba(picture)
    seen = pixels[..., 3] > 0
    assert np.abs(pixels[seen][:, :3].astype(int) - linear_to_srgb8(np.array([0.2, 0.4, 0.6]))).max() <= 1
    assert np.array_equal(pixels[..., 3], (picture[..., 3] * 255 + 0.5).astype(np.uint8))


def test_a_held_out_mesh_hides_hair_and_is_empty():
    near, far = plain(fringe(count=30, depth=0.02), (1, 0, 0)), plain(fringe(count=30, seed=1, depth=-0.2), (0, 1, 0))
    gbuffer = drawn([near, far], [wall()])
    hair = premultiplied_rgba(gbuffer, style=PhotoStyle(), hold_out_meshes=True)
    assert hair[..., 1].max() == 0
    assert hair[..., 0].max() == 1
    assert np.array_equal(hair[..., 0], hair[..., 3])
    assert premultiplied_rgba(gbuffer, style=PhotoStyle())[..., 3].min() == 1


def test_a_texture_lies_upright_on_its_mesh():
    pixels = np.zeros((2, 2, 3), np.uint8)
    pixels[0, 0], pixels[0, 1], pixels[1, 0] = (255, 0, 0), (0, 255, 0), (0, 0, 255)
    square = wall(half=0.07, corner_uv=QUAD_UV, texture=Texture(pixels=pixels))
    picture = srgb_rgb(premultiplied_rgba(drawn([], [square]), style=PhotoStyle()), background=(1, 1, 1))
    assert picture[4, 14].tolist() == [255, 0, 0], "upper left"
    assert picture[4, 66].tolist() == [0, 255, 0], "upper right"
    assert picture[56, 14].tolist() == [0, 0, 255], "lower left"


def test_bilinear_is_exact_at_texel_centres_and_linear_between():
    pixels = np.random.default_rng(0).integers(0, 256, (4, 5, 3), dtype=np.uint8)
    centre = np.array([[(2 + 0.5) / 5, 1 - (1 + 0.5) / 4]])
    assert np.allclose(bilinear(pixels, uv=centre), srgb_to_linear(pixels[1, 2]), atol=1e-6)
    between = np.array([[3 / 5, 1 - (1 + 0.5) / 4]])
    expected = 0.5 * (srgb_to_linear(pixels[1, 2]) + srgb_to_linear(pixels[1, 3]))
    assert np.allclose(bilinear(pixels, uv=between), expected, atol=1e-6)


def test_vertex_colours_and_clay():
    red = wall(vertex_attributes={"color": np.tile(np.float32([0.8, 0.1, 0.1]), (4, 1))})
    assert np.allclose(premultiplied_rgba(drawn([], [red]), style=PhotoStyle())[30, 40], [0.8, 0.1, 0.1, 1])
    clay = premultiplied_rgba(drawn([], [wall()]), style=PhotoStyle())[30, 40]
    assert 0.3 < clay[:3].min() <= clay[:3].max() < 0.7


def test_the_photo_style_shows_the_colours_as_they_are():
    hair = plain(fringe(), (0.25, 0.5, 0.75))
    picture = premultiplied_rgba(drawn([hair]), style=PhotoStyle())
    assert np.allclose(straight_rgba(picture)[..., :3], [0.25, 0.5, 0.75], atol=1e-6)


def test_soft_settings_keep_the_mean_brightness_roughly():
    hair = plain(fringe(), (0.25, 0.5, 0.75))
    soft = premultiplied_rgba(drawn([hair]), style=PhotoStyle.soft())
    ratio = soft[..., :3].mean(axis=(0, 1)) / [0.25, 0.5, 0.75]
    assert np.ptp(ratio) < 1e-5, "hue stays"
    assert 0.6 < ratio.mean() < 1.3


@pytest.mark.parametrize("style", STYLES, ids=lambda s: s.name)
class TestEveryStyle:
    def test_shades_all_fragments_with_finite_light(self, style):
        gbuffer = drawn([fringe(count=50)], [wall(z=-0.1)])
        rgba = style().shade(gbuffer)
        assert rgba.shape == (len(gbuffer.fragments.weight), 4)
        assert rgba.dtype == np.float32
        assert np.isfinite(rgba).all()
        assert rgba.min() >= 0

    def test_gives_a_fresh_array(self, style):
        gbuffer = drawn([fringe(count=50)])
        first = style().shade(gbuffer)
        first[:] = 7
        assert style().shade(gbuffer).max() != 7 or not np.array_equal(style().shade(gbuffer), first)

    def test_knows_an_empty_scene(self, style):
        assert style().shade(drawn()).shape == (0, 4)

    def test_names_are_unique(self, style):
        assert [s.name for s in STYLES].count(style.name) == 1

    def test_hair_with_twice_the_colour_never_is_darker(self, style):
        dark = premultiplied_rgba(drawn([plain(fringe(), (0.1, 0.2, 0.3))]), style=style())
        light = premultiplied_rgba(drawn([plain(fringe(), (0.2, 0.4, 0.6))]), style=style())
        assert (light >= dark - 1e-6).all()
        assert light.mean() > dark.mean()
