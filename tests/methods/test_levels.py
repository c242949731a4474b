"""Levels of detail: budgets, the same surfaces, coverage, distances, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from ball_hair import ball_hair
from hypothesis import given
from hypothesis import strategies as st

from tress.base.errors import InputError
from tress.base.report import Report
from tress.kernel import nurbs
from tress.kernel.alpha_coverage import alpha_coverage
from tress.methods.strips.level_likeness import level_points, likeness, spacing_for, views_of
from tress.methods.strips.level_switch import level_for
from tress.methods.strips.level_textures import level_atlases
from tress.methods.strips.levels import LevelParams, level_chain, shown_strips
from tress.methods.strips.merging import ALONG, merged
from tress.methods.strips.visible_area import visible_area
from tress.model.document import Document
from tress.model.level import Level, level_surface, widening_matrix
from tress.model.mesh import Mesh
from tress.model.strip_set import posed_points, strip_set
from tress.render.card_points import card_points, card_view

HAIR = ball_hair(90, moving=True)
PARAMS = LevelParams(padding=8)
BUDGETS = (6000, 2000, 500)
CHAIN = level_chain(HAIR, budgets=BUDGETS, params=PARAMS)


def test_no_level_exceeds_its_budget_and_each_uses_most_of_it():
    for level, budget in zip(CHAIN.levels, BUDGETS, strict=True):
        assert 0.9 * budget <= level.triangles <= budget
        assert len(level_surface(HAIR, level).grid.triangles) <= level.triangles


def test_levels_hold_ever_fewer_of_the_same_strips():
    names = [set(level.names) for level in CHAIN.levels]
    assert names[0] == set(shown_strips(HAIR)) and names[2] < names[1] <= names[0]
    assert (CHAIN.levels[0].widening == 1).all() and CHAIN.levels[2].widening.max() > 1
    assert {HAIR.records[name].group for name in CHAIN.levels[2].names} == {"crown", "sides"}


@pytest.mark.parametrize("time", [0.0, 0.7])
def test_vertices_lie_on_the_surfaces_of_the_document_in_every_pose(time):
    level = replace(CHAIN.levels[1], widening=np.ones(len(CHAIN.levels[1].names)))
    surface = level_surface(HAIR, level)
    points = posed_points(surface.strips, time)
    found = surface.grid.points(points)
    uv = surface.grid.fraction
    for strip in (0, 40):
        mine = surface.grid.strip == strip
        one = surface.strips.records[strip]
        low, high = one.knots_u[[0, -1]], one.knots_v[[0, -1]]
        at = np.column_stack([low[0] + uv[mine, 0] * (low[1] - low[0]), high[0] + uv[mine, 1] * (high[1] - high[0])])
        own = points[surface.strips.offsets[strip] : surface.strips.offsets[strip + 1]].reshape(one.points.shape)
        patch = nurbs.Patch(own, one.weights, one.knots_u, one.knots_v, *one.degrees)
        assert np.abs(nurbs.evaluate(patch, uv=at) - found[mine]).max() < 1e-12


def test_widening_keeps_the_middle_and_scales_the_width():
    strips = strip_set(HAIR, shown_strips(HAIR)[:7])
    factors = np.linspace(1, 3, 7)
    wider = strips.nets(widening_matrix(strips.records, factors) @ strips.points)
    for strip, net, factor in zip(strips.records, wider, factors, strict=True):
        assert np.allclose(net.mean(axis=1), strip.points.mean(axis=1), atol=1e-15)
        assert np.allclose(net[:, -1] - net[:, 0], factor * (strip.points[:, -1] - strip.points[:, 0]), atol=1e-15)


@pytest.mark.parametrize(("number", "iou"), [(1, 0.9), (2, 0.82)])
def test_a_level_looks_like_the_first_where_it_takes_over(number, iou):
    px = PARAMS.px_at_1_m / CHAIN.takeover_m[number - 1]
    clouds = [
        level_points(HAIR, CHAIN.levels[k], atlases=CHAIN.atlases[k], spacing_m=spacing_for(px)) for k in (0, number)
    ]
    first, mine = views_of(clouds, px_per_m=px)
    found = likeness(mine, first)
    assert found.silhouette_iou > iou
    assert 0.93 < found.coverage < 1.07
    assert found.color_difference < 4
    assert likeness(first, first) == likeness(mine, mine)


def test_merging_takes_what_shows_least_first_and_nothing_of_another_kind():
    middles = np.zeros((6, ALONG, 3)) + np.array([0, 1, 1.1, 5, 6, 6.2])[:, None, None]
    found = merged(middles, importance=np.array([1, 1, 0.5, 1, 1, 2]), kind=np.array([0, 0, 0, 1, 1, 1]), count=4)
    assert found.kept.tolist() == [0, 1, 3, 5]
    assert found.heir.tolist() == [0, 1, 1, 3, 5, 5]
    fewest = merged(middles, importance=np.ones(6), kind=np.array([0, 0, 0, 1, 1, 1]), count=1)
    assert len(fewest.kept) == 2


def test_a_strip_hidden_by_another_shows_nothing():
    from tress.model.strip_shapes import flat_strip

    near = flat_strip(length_m=0.1, width_m=0.1)
    inside = replace(near, points=near.points * 0.3 + [0.035, 0, 0])
    caught = {"a": near, "b": replace(near, points=near.points + [0, 0, 1e-3])}
    strips = strip_set(Document({**caught, "c": replace(inside, points=inside.points + [0, 0, 5e-4])}), ["a", "b", "c"])
    seen = visible_area(Document({}), strips)
    assert seen[2] < 0.05 * seen[0] and seen[0] == pytest.approx(seen[1], rel=0.2)


def test_a_square_of_points_fills_its_pixels():
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    square = Mesh(positions=corners, triangles=[[0, 1, 2], [0, 2, 3]])
    behind = replace(square, positions=corners * 3 - [1, 1, 1])
    points = card_points([square], [behind], spacing_m=0.01)
    view = card_view(points, xy_from_world=[[10, 0, 0, 10], [0, -10, 0, 20], [0, 0, 0, 1]], width=30, height=30)
    assert view.filled.mean() > 0.99
    assert view.hair[10:20, 10:20].mean() > 0.99 and view.hair.sum() == pytest.approx(100, abs=1)


@pytest.mark.parametrize(
    ("budgets", "params", "message"),
    [
        ((), {}, "No budget"),
        ((200, 400), {}, "200, 400 triangles; positive numbers that fall"),
        ((300, 0), {}, "positive numbers that fall"),
        ((300, 100), {"keep_all": True}, "Level 1 has a budget of 100 triangles for 90 strips that must stay"),
        ((3,), {}, "Level 0 has a budget of 3 triangles for 2 strips that must stay; at least 4"),
    ],
)
def test_budgets_that_cannot_be_met_are_refused(budgets, params, message):
    with pytest.raises(InputError, match=message):
        level_chain(HAIR, budgets=budgets, params=LevelParams(**params))


def test_a_document_without_strips_has_no_levels():
    with pytest.raises(InputError, match="shows no strips"):
        level_chain(Document({}), budgets=(100,))


def test_all_strips_stay_where_that_is_asked_for():
    chain = level_chain(HAIR, budgets=(1000, 180), params=LevelParams(keep_all=True, padding=8))
    assert [len(level.names) for level in chain.levels] == [90, 90]
    assert chain.levels[1].triangles == 180


def test_wrong_levels_are_refused():
    with pytest.raises(InputError, match="positive"):
        Level(names=("a",), segments=np.array([[0, 1]]), widening=np.ones(1))
    with pytest.raises(InputError, match="segments"):
        Level(names=("a",), segments=np.ones((2, 2), int), widening=np.ones(1))


def test_textures_halve_with_every_doubling_and_keep_their_coverage():
    levels = level_atlases(HAIR, takeover_m=(2.0, 4.0), padding=8, threshold=0.5, report=Report())
    atlases = [level["atlas"] for level in levels]
    assert [atlas.color.shape[1] for atlas in atlases] == [256, 128, 64]
    covered = [alpha_coverage(atlas.color[..., 3] / np.float32(255), threshold=0.5) for atlas in atlases]
    assert covered[1:] == pytest.approx([covered[0]] * 2, rel=0.05)


def test_textures_that_cannot_be_made_smaller_are_named():
    report = Report()
    with report.stage("textures"):
        levels = level_atlases(HAIR, takeover_m=(2.0,), padding=200, threshold=0.5, report=report)
    assert levels[1]["atlas"] == levels[0]["atlas"]
    assert "keeps its resolution" in report.stages[0].warnings[0]


@given(st.lists(st.floats(0.1, 10), max_size=30), st.floats(0, 0.3))
def test_levels_change_once_on_the_way_out_and_once_back(walk, hysteresis):
    border, level = (2.0, 4.0), None
    for distance in walk:
        before, level = level, level_for(distance, level, takeover_m=border, hysteresis=hysteresis)
        plain = level_for(distance, takeover_m=border)
        assert 0 <= level <= 2
        if all(abs(distance / each - 1) > hysteresis for each in border):
            assert level == plain
        if before is not None and before != level:
            assert level == level_for(distance, level, takeover_m=border, hysteresis=hysteresis)


def test_nothing_flickers_at_a_border():
    level, changes = None, 0
    for step in range(100):
        level, before = level_for(2.0 + 0.1 * (-1) ** step, level, takeover_m=(2.0, 4.0)), level
        changes += before is not None and before != level
    assert changes == 0


def test_distances_follow_the_pixels_of_a_triangle():
    surface = level_surface(HAIR, CHAIN.levels[0])
    area = visible_area(HAIR, surface.strips).sum()
    for level, distance in zip(CHAIN.levels[1:], CHAIN.takeover_m, strict=True):
        assert area * (PARAMS.px_at_1_m / distance) ** 2 / level.triangles == pytest.approx(PARAMS.pixels)
