"""The styles of strips: layers blended exactly, light by closed form, highlights where a mirror has them."""

import itertools

import numpy as np
import pytest

from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.strip_grid import grid_triangles
from tress.model.texture import Texture
from tress.render.flat_scene import flat_scene
from tress.render.gbuffer import rasterise
from tress.render.mesh_frames import mesh_frames, vertex_normals
from tress.render.occlusion import mesh_light_transmittance
from tress.render.picture import premultiplied_rgba
from tress.render.strip_light import Gloss, StripSurface, highlight, lit_strips
from tress.render.styles import STYLES
from tress.render.styles.gouraud import GouraudStyle
from tress.render.styles.textured import TexturedStyle
from tress.render.textures.encode import direction_bytes

CAMERA = np.array([[200.0, 0, 0, 32], [0, -200.0, 0, 32], [0, 0, 0, 1]])
SIZE = {"width": 64, "height": 64}
ROWS, COLUMNS = 33, 3
PLAIN = {"light": 0.0, "sky": 1.0, "shine": 0.0, "sheen": 0.0}


def strip(*, place, color=(255, 255, 255, 255), pixels=None):
    """A strip of a grid of points `place` (ROWS, COLUMNS, 3), root first, with a texture of one colour."""
    t, s = np.meshgrid(np.linspace(0, 1, ROWS), np.linspace(0, 1, COLUMNS), indexing="ij")
    triangles = grid_triangles(ROWS, COLUMNS)
    uv = np.stack([s.ravel(), 1 - t.ravel()], axis=1)
    pixels = np.full((4, 4, 4), color, np.uint8) if pixels is None else pixels
    return Mesh(
        positions=place.reshape(-1, 3),
        triangles=triangles,
        corner_uv=uv[triangles],
        vertex_attributes={"fraction": np.stack([t.ravel(), s.ravel()], axis=1).astype(np.float32)},
        texture=Texture(pixels=pixels),
    )


def flat(*, z=0.0, half=0.2, **more):
    y, x = np.meshgrid(np.linspace(half, -half, ROWS), np.linspace(-half, half, COLUMNS), indexing="ij")
    return strip(place=np.stack([x, y, np.full_like(x, z)], axis=-1), **more)


def bent(*, radius=0.1, **more):
    """Half a turn of a cylinder about the X axis, from the top over the front to the bottom."""
    angle, x = np.meshgrid(np.linspace(0, np.pi, ROWS), np.linspace(-0.15, 0.15, COLUMNS), indexing="ij")
    return strip(place=np.stack([x, radius * np.cos(angle), radius * np.sin(angle)], axis=-1), **more)


def picture(meshes, *, style, **more):
    scene = flat_scene(Scene(meshes={f"m{i}": mesh for i, mesh in enumerate(meshes)}), **more)
    return premultiplied_rgba(rasterise(scene, xy_from_world=CAMERA, **SIZE), style=style)


def test_both_are_listed():
    assert {"gouraud", "textured"} <= {style.name for style in STYLES}


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_half_transparent_strips_blend_alike_in_any_order(order, monkeypatch):
    monkeypatch.setattr("tress.render.occlusion._LAYER", 0.0)
    red, green, blue = (255, 0, 0, 102), (0, 255, 0, 51), (0, 0, 255, 255)
    layers = [flat(z=0.02, color=red), flat(z=0.01, color=green), flat(z=0.0, color=blue)]
    rgba = picture([layers[i] for i in order], style=TexturedStyle(**PLAIN))
    np.testing.assert_allclose(rgba[32, 32], [0.4, 0.6 * 0.2, 0.6 * 0.8, 1], atol=1e-4)


def test_textures_show_their_strands_and_nothing_between():
    pixels = np.full((4, 4, 4), 255, np.uint8)
    pixels[:, 2:, 3] = 0
    rgba = picture([flat(pixels=pixels)], style=TexturedStyle(**PLAIN))
    assert rgba[32, 4, 3] == 1 and rgba[32, 60, 3] == 0
    opaque = picture([flat(pixels=pixels)], style=TexturedStyle(**PLAIN), see_through=False)
    assert opaque[32, 60, 3] == 1


@pytest.mark.parametrize("style", [GouraudStyle, TexturedStyle])
def test_light_from_ahead_on_a_strip_that_faces_it_is_the_color_times_the_light(style, monkeypatch):
    monkeypatch.setattr("tress.render.occlusion._LAYER", 0.0)
    lit = style(azimuth_rad=0.0, elevation_rad=0.0, light=0.5, sky=0.25, shine=0.0, sheen=0.0)
    rgba = picture([flat()], style=lit)
    np.testing.assert_allclose(rgba[32, 32, :3], 0.75, atol=1e-3)


@pytest.mark.parametrize("style", [GouraudStyle, TexturedStyle])
@pytest.mark.parametrize(("tilt", "elevation"), [(0.0, 0.0), (0.0, 0.8), (0.2, 0.0), (0.2, 0.8)])
def test_the_highlight_lies_where_the_tilted_fibre_is_square_to_the_half_vector(style, tilt, elevation):
    """On a cylinder, at the angle a from the top, the fibre is (-sin a, cos a) and the normal (cos a, sin a) in (y, z);
    the half vector is (sin h, cos h) with h half the elevation. So cos(a + h) + tilt sin(a + h) = 0: square at
    a = pi / 2 - h + atan(tilt).
    """
    shiny = style(
        azimuth_rad=0.0,
        elevation_rad=elevation,
        light=1.0,
        sky=0.0,
        shine=1.0,
        sheen=0.0,
        gloss=800.0,
        tilt=tilt,
    )
    rgba = picture([bent(color=(0, 0, 0, 255))], style=shiny)
    peak_row = float(np.argmax(rgba[:, 32, 0])) + 0.5
    angle = np.pi / 2 - elevation / 2 + np.arctan(tilt)
    assert peak_row == pytest.approx(32 - 200 * 0.1 * np.cos(angle), abs=1.1)


def test_the_flow_map_turns_the_highlight(monkeypatch):
    """Hair that runs across the strip by its flow map has no highlight across the strip, but one at every height."""
    monkeypatch.setattr("tress.render.occlusion._LAYER", 0.0)
    across = np.broadcast_to(direction_bytes(np.array([1.0, 0, 0])), (4, 4, 3)).copy()
    shiny = TexturedStyle(
        azimuth_rad=0.0, elevation_rad=0.0, light=1.0, sky=0.0, shine=1.0, sheen=0.0, gloss=100.0, tilt=0.0, jitter=0.0
    )
    black = bent(color=(0, 0, 0, 255))
    plain = picture([black], style=shiny)[:, 32, 0]
    turned = picture([black], style=shiny, maps={"m0": {"flow": across}})[:, 32, 0]
    assert plain[32] == pytest.approx(turned[32], rel=0.05) and plain[18] < 0.01 < 0.5 < turned[18]


def test_shifts_move_highlights_to_the_tip():
    angle = np.linspace(0.2, 3, 2000)
    zero = np.zeros_like(angle)
    along = np.stack([zero, -np.sin(angle), np.cos(angle)], axis=1)
    normal = np.stack([zero, np.cos(angle), np.sin(angle)], axis=1)
    one = np.ones_like(angle)
    surface = StripSurface(np.ones((2000, 3)), normal, along, one, one, zero)
    for shift in (-0.3, 0.0, 0.3):
        glint = highlight(surface, half=np.array([0, 0, 1.0]), shift=np.full(2000, shift), exponent=50)
        assert angle[np.argmax(glint)] == pytest.approx(np.pi / 2 + np.arctan(shift), abs=2e-3)
        assert glint.max() == pytest.approx(1, abs=1e-4)


def test_the_second_highlight_has_the_color_of_the_hair_and_the_first_that_of_the_light():
    one = np.ones(1)
    eye = np.array([0, 0, 1.0])
    color = np.array([[0.4, 0.2, 0.1]])
    surface = StripSurface(color, eye[None], np.array([[0, -1.0, 0]]), 0 * one, one, 0 * one)
    dark = lit_strips(surface, to_light=eye, to_eye=eye, gloss=Gloss(0, 0, 20, 0), light=1, sky=0)
    first = lit_strips(surface, to_light=eye, to_eye=eye, gloss=Gloss(1, 0, 20, 0), light=1, sky=0)
    second = lit_strips(surface, to_light=eye, to_eye=eye, gloss=Gloss(0, 1, 20, 0), light=1, sky=0)
    np.testing.assert_allclose(first - dark, [[1, 1, 1]], atol=1e-6)
    np.testing.assert_allclose(second - dark, color, atol=1e-6)


def test_frames_of_a_cylinder():
    mesh = bent()
    frames = mesh_frames(mesh)
    outwards = mesh.positions * [0, 10, 10]
    inner = mesh.vertex_attributes["fraction"][:, 0] * (1 - mesh.vertex_attributes["fraction"][:, 0]) > 0.01
    aligned = np.einsum("vi,vi->v", frames.normal, outwards)
    np.testing.assert_allclose(np.abs(aligned), 1, atol=2e-3)
    np.testing.assert_allclose(
        np.einsum("vi,vi->v", frames.along, outwards)[inner], 0, atol=0.02
    )  # a fifth of a step of the grid
    np.testing.assert_allclose(frames.across, np.tile([1, 0, 0], (len(outwards), 1)), atol=1e-5)
    np.testing.assert_array_equal(vertex_normals(mesh), frames.normal)


def test_strips_before_keep_light_from_what_lies_behind():
    near, far = flat(z=0.05, color=(255, 255, 255, 128)), flat(z=0.0)
    style = TexturedStyle(azimuth_rad=0.0, elevation_rad=0.0, light=1.0, sky=0.0, shine=0.0, sheen=0.0)
    alone = picture([far], style=style)[32, 32, 0]
    behind = picture([far, near], style=style)[32, 32, 0]
    assert behind < 0.97 * alone


def test_light_passes_along_strips_and_not_through_them():
    standing = flat_scene(Scene(meshes={str(k): flat(z=0.01 * k) for k in range(20)}))
    along, through = (
        mesh_light_transmittance(standing, towards_light=np.array(way)) for way in ([0.0, 1, 0], [0.0, 0, 1])
    )
    assert along.min() > 0.99
    behind = standing.positions[:, 2] < 0.005
    assert through[behind].mean() < 0.1 * along[behind].mean()
