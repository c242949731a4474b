"""Toon shading: lit shares of a ball by closed form, clumps that meld, the ring where it belongs."""

import numpy as np
import pytest
from render.toon_scene import ball, flat, seen, strips, toon

from tress.base.tone_ramp import ToneParams
from tress.model.evaluate import Scene
from tress.model.strands import Strands
from tress.render.flat_scene import flat_scene
from tress.render.gbuffer import rasterise
from tress.render.picture import premultiplied_rgba
from tress.render.ring import RingParams, closed_strips, lens_across
from tress.render.styles import STYLES
from tress.render.styles.toon import ToonStyle

AHEAD = {"azimuth_rad": 0.0, "elevation_rad": 0.0}
HALF = ToneParams(edge=0.0, shade=0.0, cool=0.0)


def test_it_is_listed():
    assert "toon" in {style.name for style in STYLES}


@pytest.mark.parametrize("azimuth", [0.0, 0.7, np.pi / 2, 2.5])
def test_the_lit_part_of_a_ball_is_that_of_the_moon(azimuth):
    """Seen at an angle a from the light, (1 + cos a) / 2 of the disc is lit."""
    rgba = toon(ball(), azimuth_rad=azimuth, elevation_rad=0.0, meld=0.0, tones=HALF)
    assert rgba[..., 0].sum() / rgba[..., 3].sum() == pytest.approx((1 + np.cos(azimuth)) / 2, abs=0.006)


@pytest.mark.parametrize("edge", [0.3, 0.6, 0.9])
def test_under_light_from_ahead_tones_are_rings_of_known_area(edge):
    """The cosine is above e within the radius sqrt(1 - e^2): 1 - e^2 of the disc."""
    rgba = toon(ball(), meld=0.0, tones=ToneParams(edge=edge, shade=0.0, cool=0.0), **AHEAD)
    assert rgba[..., 0].sum() / rgba[..., 3].sum() == pytest.approx(1 - edge**2, abs=0.006)


def test_areas_are_flat_and_their_borders_one_pixel_wide():
    """Pixels between the two tones lie on the border, about as many as it is long."""
    rgba = toon(ball(), size=256, meld=0.0, tones=ToneParams(edge=0.6, shade=0.5, cool=0.0), **AHEAD)
    inside = rgba[..., 3] == 1
    between = inside & (np.abs(rgba[..., 0] - 0.5) > 1e-4) & (np.abs(rgba[..., 0] - 1) > 1e-4)
    around = 2 * np.pi * 80 * 0.8
    assert 0.7 * around < between.sum() < 2.0 * around


def test_melded_strips_have_the_tone_of_the_body_and_not_their_own():
    """Two bowed strips side by side: with their own normals each is lit and shaded, as one body there is one border."""

    def bowed(left):
        points = flat(left=left, right=left + 0.05)
        bow = np.sin(np.linspace(0, np.pi, points.shape[1]))
        points[..., 2] += 0.08 + 0.02 * bow
        return points

    hair = strips(bowed(-0.05), bowed(0.0))
    light = {"azimuth_rad": 1.2, "elevation_rad": 0.0, "tones": HALF}
    borders = [
        int((np.diff((toon(hair, meld=meld, **light)[64, 46:82, 0] > 0.5).astype(int)) != 0).sum())
        for meld in (0.0, 1.0)
    ]
    assert borders[0] >= 3 and borders[1] <= 1


@pytest.mark.parametrize("fraction", [0.25, 0.6])
def test_the_ring_lies_at_its_part_of_the_length(fraction):
    ring = RingParams(by="fraction", fraction=fraction, width=0.2, teeth=0.0, gleam=1.0)
    rgba = toon(strips(flat()), ring=ring, tones=ToneParams(tones=1), **AHEAD)
    plain = toon(strips(flat(), color=(0.2,) * 3), ring=ring, tones=ToneParams(tones=1), **AHEAD)
    bright = np.flatnonzero(plain[:, 64, 0] > 0.6)
    rows = np.array([fraction - 0.1, fraction + 0.1]) * 64 + 32  # 16 cm are 64 px, from row 32
    assert abs(bright[0] - rows[0]) <= 1 and abs(bright[-1] + 1 - rows[1]) <= 1
    assert rgba[bright[0], 64, 0] == pytest.approx(1)


def test_teeth_narrow_the_ring_to_the_sides():
    ring = RingParams(by="fraction", fraction=0.5, width=0.4, teeth=1.0, gleam=1.0)
    bright = toon(strips(flat(), color=(0.2,) * 3), ring=ring, tones=ToneParams(tones=1))[..., 0] > 0.6
    high = bright.sum(axis=0)
    # The strip is 40 px wide, from column 44; the lens is 0.4 of 64 px times a sine.
    for column in (47, 54, 64, 78):
        assert high[column] == pytest.approx(25.6 * np.sin(np.pi * (column + 0.5 - 44) / 40), abs=1.6)


def test_the_ring_by_light_lies_where_a_ball_of_hair_is_a_mirror():
    """On a ball the half vector between viewer and light, e above the view, points out at the height sin(e / 2)."""
    latitude, longitude = np.meshgrid(np.linspace(0.1, 3.0, 60), np.linspace(-1.5, 1.5, 60), indexing="ij")
    around = np.stack(
        [np.sin(latitude) * np.sin(longitude), np.cos(latitude), np.sin(latitude) * np.cos(longitude)], axis=-1
    )
    hair = strips(0.1 * around, color=(0.2,) * 3)
    ring = RingParams(by="light", width=0.1, teeth=0.0, gleam=1.0)
    rgba = toon(
        hair, ball(radius=0.09), ring=ring, meld=1.0, azimuth_rad=0.0, elevation_rad=0.8, tones=ToneParams(tones=1)
    )
    row = np.average(np.arange(128) + 0.5, weights=rgba[:, 64, 2] > 0.9)
    # The body's middle is half-way up its upper half, 5 cm above that of the ball: from there, at the angle e / 2.
    up, middle = np.sin(0.4), 0.05
    height = middle + up * (np.sqrt((middle * up) ** 2 + 0.1**2 - middle**2) - middle * up)
    assert row == pytest.approx(64 - 400 * height, abs=1.5)


def test_closed_clumps_have_two_faces_and_strips_one():
    angle = np.linspace(0, 2 * np.pi, 17)
    tube = np.stack(
        np.broadcast_arrays(0.02 * np.cos(angle), np.linspace(0.1, -0.1, 9)[:, None], 0.02 * np.sin(angle)), axis=-1
    )
    mesh = strips(tube, flat())
    assert closed_strips(mesh).tolist() == [True, False]
    lens = np.abs(np.sin(lens_across(mesh)))
    assert lens[: len(angle)][[0, 4, 8, 12, 16]] == pytest.approx([0, 1, 0, 1, 0], abs=1e-6)
    assert lens[tube[..., 0].size :][:9][[0, 4, 8]] == pytest.approx([0, 1, 0], abs=1e-6)


def test_a_scalp_has_its_color_up_to_a_sharp_border():
    head = ball()
    height = head.positions[:, 1]
    attributes = {
        "color": np.ones_like(head.positions),
        "scalp": (0.5 + 2 * height).astype(np.float32),
        "scalp_color": np.zeros_like(head.positions),
    }
    mesh = type(head)(positions=head.positions, triangles=head.triangles, vertex_attributes=attributes)
    column = toon(mesh, meld=0.0, tones=ToneParams(tones=1))[:, 64, 0]
    assert (column[30:63] == 0).all() and (column[65:98] > 0.9999).all()


def test_single_strands_have_tones_and_the_background_is_empty():
    x = np.linspace(-0.06, 0.06, 80)
    points = np.stack([np.stack([x, np.full_like(x, y), np.full_like(x, 0.05)], axis=1) for y in (0.1, -0.1)], axis=1)
    hair = Strands(
        points=points.reshape(-1, 3),
        offsets=np.arange(81) * 2,
        point_attributes={"radius": np.full(160, 0.001), "color": np.full((160, 3), 0.4)},
    )
    camera = np.array([[400.0, 0, 0, 64], [0, -400.0, 0, 64], [0, 0, 0, 1]])
    buffer = rasterise(flat_scene(Scene(strands={"hair": hair})), xy_from_world=camera, width=128, height=128)
    rgba = premultiplied_rgba(buffer, style=ToonStyle(azimuth_rad=1.4, elevation_rad=0.0, tones=HALF))
    assert rgba[64, 50, 0] < 0.01 and rgba[64, 80, 0] / rgba[64, 80, 3] == pytest.approx(0.4, abs=1e-3)
    assert rgba[64, 4].max() == 0


def test_an_empty_scene_stays_empty():
    assert premultiplied_rgba(seen(), style=ToonStyle()).max() == 0
