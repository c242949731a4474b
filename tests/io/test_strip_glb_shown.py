"""Strips as GLB in other programs: three.js in a browser, and Blender."""

import numpy as np
import pytest
from ball_hair import ball_hair
from blender import blender_report
from browser import shown_by_three

from tress.io.card_levels import card_levels, plain_level
from tress.io.formats.glb import encode_glb, scene_beside_strips
from tress.io.formats.registry import format_of
from tress.methods.strips.level_likeness import level_points, spacing_for
from tress.model.atlas import Atlas
from tress.model.level import Level
from tress.model.posed import posed
from tress.render.card_points import card_view

HAIR = ball_hair(60, moving=True)


@pytest.fixture(scope="module")
def three_levels(tmp_path_factory):
    """A file with three levels, a head, transparency and a clip."""
    plain = plain_level(HAIR)
    assert plain is not None
    coarse = [
        Level(plain.names[::step], np.full((60 // step, 2), (rows, 1)), np.full(60 // step, float(step)))
        for step, rows in ((1, 6), (2, 4))
    ]
    made = card_levels(HAIR, [plain, *coarse], coverage=(0.4, 0.2, 0))
    path = tmp_path_factory.mktemp("glb") / "hair.glb"
    path.write_bytes(encode_glb(scene_beside_strips(HAIR), strips=made))
    return path


def test_three_js_shows_hair_that_moves(three_levels, tmp_path):
    shown = shown_by_three(three_levels, tmp_path)
    # The clip moves all levels; of those that three.js does not load it says so.
    assert [error for error in shown.errors if "No target node found for track: strips_lod" not in error] == []
    assert shown.meshes == ["head", "strips_lod0"]
    ((name, seconds),) = shown.clips
    assert name == "motion" and seconds == pytest.approx(2.0)
    hair = shown.hair(0) > 0.5
    assert 0.1 < hair.mean() < 0.7
    brown = shown.pictures[0][hair].mean(axis=0)
    assert brown[0] > brown[1] > brown[2]
    # Tips fray: along the lower half of the hair, background is seen between strands of one row.
    low = hair[np.flatnonzero(hair.any(axis=1))[-60:]]
    assert (np.diff(low.astype(int), axis=1) != 0).sum(axis=1).max() >= 6
    # What three.js draws is what Tress draws, at rest and half a second into the clip, and these differ.
    drawn = [_drawn(posed(HAIR, moment), shown) for moment in (0.0, 0.5)]
    for number in (0, 1):
        assert _overlap(shown.hair(number), drawn[number]) > 0.88
        assert shown.hair(number).sum() == pytest.approx(drawn[number].sum(), rel=0.06)
    assert _overlap(shown.hair(1), drawn[0]) < 0.75


def _drawn(document, shown):
    """(H, W) hair as Tress draws the finest level, with the browser's camera."""
    level = plain_level(document)
    scale = np.linalg.norm(shown.xy_from_world[0, :3])
    points = level_points(document, level, atlases=document.of_type(Atlas), spacing_m=spacing_for(scale))
    height, width = shown.pictures[0].shape[:2]
    return card_view(points, xy_from_world=shown.xy_from_world, width=width, height=height).hair


def _overlap(mine, other):
    both = mine > 0.5, other > 0.5
    return (both[0] & both[1]).sum() / (both[0] | both[1]).sum()


def test_blender_imports_glb_and_usd(three_levels, tmp_path):
    usd = tmp_path / "hair.usdc"
    format_of(usd).write(HAIR, usd)
    glb, stage = (blender_report(path) for path in (three_levels, usd))
    hair = glb["meshes"]["strips_lod0"]
    assert hair["shape_keys"] == 3 and hair["vertices"] > 1000
    assert hair["moved"] > 0.01
    assert {"strips_lod1", "strips_lod2"} <= set(glb["meshes"])
    assert sum(one["vertices"] for one in stage["meshes"].values()) > 2000
    assert max(one["moved"] for one in stage["meshes"].values()) > 0.01
