"""What holds for every preset of strips."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial import KDTree

from tress.base.errors import InputError
from tress.base.report import Report
from tress.edit.clearances import clearances
from tress.head.assets import DATA
from tress.io.formats.usd import open_document, save_document
from tress.methods.strips.hairdo import hairdo
from tress.methods.strips.params import StripsParams
from tress.methods.strips.presets.registry import PRESETS, preset_of
from tress.methods.strips.scalp_seen import VIEWS, scalp_seen
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.model.head import Head
from tress.model.strip import Strip
from tress.model.strip_mesh import strips_mesh
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_atlas import strand_atlas

pytestmark = pytest.mark.skipif(not (DATA / "head.npz").is_file(), reason="`make assets` has not built the head")

NAMES = [preset.name for preset in PRESETS]
FEW = StripsParams(strips=150)
REACH_M, COVERED = 0.015, 0.98
SEEN, MOST_SEEN = 0.03, 0.06
"""Shares of the scalp that may show through, in the mean over the views and in any of them."""


@cache
def grown(name: str) -> Document:
    return hairdo(name, params=FEW, atlas=strands())


@cache
def strands() -> Atlas:
    return strand_atlas(TextureParams(resolution=512), report=Report())


def head_of(document: Document) -> Head:
    head = document.records["head"]
    assert isinstance(head, Head)
    return head


def test_there_are_the_six_that_a_person_knows():
    assert {"long_straight", "bob", "short_crop", "side_parting", "wavy_shoulder", "ponytail"} <= set(NAMES)
    assert all(preset.words for preset in PRESETS)


@pytest.mark.parametrize("name", NAMES)
def test_no_strip_lies_inside_the_head(name):
    assert min(clearances(grown(name), names=["hair"], surface="head", density=3).values()) >= 0


@pytest.mark.parametrize("name", NAMES)
def test_the_scalp_is_covered(name):
    document = grown(name)
    mesh = head_of(document).mesh
    scalp = mesh.positions[mesh.vertex_attributes["scalp"] > 0.5]
    hair = strips_mesh(document, names=sorted(document.of_type(Strip))).positions
    distance = KDTree(hair).query(scalp)[0]
    assert (distance < REACH_M).mean() >= COVERED


@pytest.mark.parametrize("name", NAMES)
def test_no_bald_place_shows_where_engines_test_the_alpha(name):
    seen = scalp_seen(hairdo(name, atlas=strands()))
    assert np.mean(list(seen.values())) <= SEEN and max(seen.values()) <= MOST_SEEN, seen


def test_the_scalp_of_a_bald_head_is_seen_whole():
    assert scalp_seen(bare()) == dict.fromkeys(VIEWS, pytest.approx(1))


@pytest.mark.parametrize("name", NAMES)
def test_every_root_is_on_the_scalp_and_every_strip_in_the_hair(name):
    document = grown(name)
    mesh = head_of(document).mesh
    scalp = mesh.vertex_attributes["scalp"]
    for strip in document.of_type(Strip).values():
        assert strip.root is not None and strip.root.surface == "head" and strip.group
        assert scalp[mesh.triangles[strip.root.triangle]] @ strip.root.barycentric > 0.2
        assert np.abs(strip.points[0].mean(axis=0)).max() < 0.02


@pytest.mark.parametrize("name", NAMES)
def test_the_count_is_about_what_was_asked(name):
    assert 0.75 * FEW.strips <= len(grown(name).of_type(Strip)) <= 1.35 * FEW.strips


@pytest.mark.parametrize("name", NAMES)
def test_it_comes_back_from_usd(name, tmp_path):
    save_document(grown(name), tmp_path / "hair.usdc")
    assert open_document(tmp_path / "hair.usdc") == grown(name)


@pytest.mark.parametrize("name", NAMES)
def test_the_same_seed_gives_the_same_bits_and_another_one_other_hair(name):
    few = StripsParams(strips=60)
    assert preset_of(name).grow(bare(), few) == preset_of(name).grow(bare(), few)
    assert preset_of(name).grow(bare(), few) != preset_of(name).grow(bare(), StripsParams(strips=60, seed=1))


def bare() -> Document:
    return Document({"head": head_of(grown("bob"))})


def test_longer_hair_is_longer():
    long = hairdo("long_straight", params=StripsParams(strips=60, length=1.3))
    plain = hairdo("long_straight", params=StripsParams(strips=60))
    lowest = [strips_mesh(d, names=sorted(d.of_type(Strip))).positions[:, 1].min() for d in (long, plain)]
    assert lowest[0] < lowest[1] - 0.05


def test_the_report_says_what_was_inside():
    report = Report()
    hairdo("short_crop", params=StripsParams(strips=60), report=report)
    numbers = {stage.name: stage.numbers for stage in report.stages}
    assert numbers["push out"]["left_inside"] == 0 and numbers["grow"]["strips"] > 40


def test_an_unknown_preset_gets_one_error_with_the_choices():
    with pytest.raises(InputError, match=r"'bobb'; did you mean bob\? one of long_straight, .*ponytail was expected"):
        preset_of("bobb")
