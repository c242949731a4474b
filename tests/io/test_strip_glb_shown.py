"""Strips as GLB in other programs: three.js in a browser, and Blender."""

import numpy as np
import pytest
from ball_hair import ball_hair
from blender import blender_report
from browser import shown_by_three

from tress.io.card_levels import card_levels, plain_level
from tress.io.formats.glb import encode_glb, scene_beside_strips
from tress.io.formats.registry import format_of
from tress.model.level import Level

HAIR = ball_hair(60, moving=True)
BLUE = np.array([0, 0, 255])


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
    rest, moved = (picture.astype(int) for picture in shown.pictures)
    hair = np.abs(rest - BLUE).sum(axis=2) > 60
    assert 0.1 < hair.mean() < 0.7
    brown = rest[hair].mean(axis=0)
    assert brown[0] > brown[1] > brown[2]
    # Tips fray: along the lower half of the hair, background is seen between strands of one row.
    low = hair[np.flatnonzero(hair.any(axis=1))[-20:]]
    assert (np.diff(low.astype(int), axis=1) != 0).sum(axis=1).max() >= 6
    assert (np.abs(rest - moved).sum(axis=2) > 30).mean() > 0.01


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
