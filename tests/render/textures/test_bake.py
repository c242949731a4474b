"""A baked card: one straight strand has closed forms, and any card keeps the laws of directions."""

import numpy as np
import pytest

from tress.render.textures.bake import bake_card, strand_ids
from tress.render.textures.card_kinds import KINDS
from tress.render.textures.card_strands import HALF_DEPTH, MARGIN, CardStrands, card_strands
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_colors import strand_colors

WIDTH, HEIGHT = 48, 144


def straight(direction=(0.0, 1.0, 0.0), *, start=(0.5, 0.0, 0.06), length=3.0, half_width=0.1) -> CardStrands:
    """One strand of constant width, 96 points along a line."""
    t = np.linspace(0, 1, 96)[None]
    points = np.asarray(start) + t[..., None] * length * np.asarray(direction)
    ones = np.ones_like(t)
    return CardStrands(points, t, half_width * ones, ones, 0 * ones, np.zeros(1, np.int64))


def baked(strands):
    return bake_card(strands, np.full((*strands.t.shape, 3), 0.25), width=WIDTH, height=HEIGHT)


def test_a_straight_strand_covers_its_area():
    card = baked(straight())
    assert card.coverage.sum() == pytest.approx(0.2 * WIDTH * HEIGHT, rel=5e-3)
    assert card.coverage.max() == 1


def test_a_straight_strand_has_the_depth_and_length_it_was_given():
    card = baked(straight())
    seen = card.coverage > 0
    rows = (np.nonzero(seen)[0] + 0.5) / HEIGHT
    np.testing.assert_allclose(card.root_to_tip[seen], rows, atol=2e-3)
    np.testing.assert_allclose(card.depth[seen], 0.5 + 0.5 * 0.06 / HALF_DEPTH, atol=1e-5)


@pytest.mark.parametrize("degrees", [0, 20, -35, 60])
def test_flow_points_along_the_strand_with_y_up(degrees):
    across, down = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    card = baked(straight((across, down, 0), start=(0.5, 1.5, 0), length=0.35, half_width=0.05))
    np.testing.assert_allclose(
        card.flow[card.coverage > 0], [[across, -down, 0]] * (card.coverage > 0).sum(), atol=1e-5
    )


def test_normals_lean_outwards_on_both_sides():
    card = baked(straight())
    middle, rows = WIDTH // 2, slice(4, -4)
    assert (card.normal[rows, middle - 4, 0] < -0.5).all() and (card.normal[rows, middle + 3, 0] > 0.5).all()
    np.testing.assert_allclose(card.normal[rows, :, 0], -card.normal[rows, ::-1, 0], atol=0.05)


def test_the_edge_of_a_strand_is_darker_than_its_middle():
    card = baked(straight())
    middle = card.color[20, WIDTH // 2, 0]
    edge = card.color[20, np.flatnonzero(card.coverage[20])[0], 0]
    assert edge < 0.9 * middle <= 0.25


def random_strands(kind="layered", seed=4, **changes):
    params = TextureParams(strands=80, **changes)
    random = np.random.default_rng(seed)
    strands = card_strands(params, kind=KINDS[kind], aspect=3.0, random=random)
    return strands, strand_colors(strands, params=params, random=random)


@pytest.mark.parametrize("kind", KINDS)
def test_strands_of_every_kind_stay_within_the_card(kind):
    strands, _ = random_strands(kind, frizz=1.0)
    x, y, z = np.moveaxis(strands.points, -1, 0)
    assert x.min() > MARGIN - 1e-9 and x.max() < 1 - MARGIN + 1e-9
    assert y.min() >= 0 and y.max() < 3 and np.abs(z).max() <= HALF_DEPTH
    assert (np.diff(y, axis=1) > 0).all() and np.isfinite(strands.points).all()


def test_normals_stand_on_the_strands_where_one_fills_a_texel():
    strands, colors = random_strands()
    card = bake_card(strands, colors, width=256, height=768)
    alone = np.linalg.norm(card.normal, axis=-1) > 0.98
    assert alone.sum() > 1000
    assert np.abs((card.normal * card.flow).sum(axis=-1)[alone]).max() < 0.05
    assert (card.normal[alone][:, 2] > 0).all()


def test_every_seen_texel_has_a_strand():
    strands, colors = random_strands()
    card = bake_card(strands, colors, width=64, height=192)
    assert ((card.strand_id > 0) == (card.coverage > 0)).all()
    assert set(np.unique(card.strand_id)) - {0} <= set(strand_ids(len(strands.points)))


def test_ids_of_the_first_255_strands_differ():
    ids = strand_ids(255)
    assert sorted(ids) == list(range(1, 256))
    assert np.abs(np.diff(ids.astype(int))).min() > 50


def test_deep_strands_are_darker():
    strands, colors = random_strands(color_variation=0.0)
    depth, light = strands.points[:, 40, 2], colors[:, 40, 0]
    order = np.argsort(depth)
    assert (np.diff(light[order]) >= -1e-6).all() and light.max() > 1.2 * light.min()
