"""What holds for every preset of cartoon hair."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial import KDTree

from tress.base.errors import InputError
from tress.edit.clearances import clearances
from tress.head.assets import DATA
from tress.io.formats.usd import open_document, save_document
from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.hairdo import hairdo
from tress.methods.cartoon.presets.registry import PRESETS
from tress.model.document import Document
from tress.model.evaluate import evaluate
from tress.model.head import Head
from tress.model.keyframes import Keyframes
from tress.model.strip import Strip
from tress.model.strip_mesh import strips_mesh
from tress.model.strips import strip_names

pytestmark = pytest.mark.skipif(not (DATA / "head.npz").is_file(), reason="`make assets` has not built the head")

NAMES = [preset.name for preset in PRESETS]
FEW = CartoonParams(clumps=0.7)
REACH_M, COVERED = 0.02, 0.98


@cache
def grown(name: str) -> Document:
    return hairdo(name, params=FEW)


def head_of(document: Document) -> Head:
    head = document.records["head"]
    assert isinstance(head, Head)
    return head


def test_there_are_the_five_of_the_genre():
    assert {"ponytail", "long_wind", "spiky", "bob_bangs", "twin_tails"} == set(NAMES)
    assert all(preset.words for preset in PRESETS)


@pytest.mark.parametrize("name", NAMES)
def test_nothing_lies_inside_the_head_at_rest_and_at_every_keyframe(name):
    document = grown(name)
    times = {float(time) for item in document.of_type(Keyframes).values() for time in item.times}
    for time in sorted({0.0, *times})[:4]:
        room = clearances(document, names=["hair"], surface="head", time=time, density=2)
        assert min(room.values()) >= -1e-5, (time, min(room, key=lambda each: room[each]))


@pytest.mark.parametrize("name", NAMES)
def test_the_scalp_is_covered(name):
    document = grown(name)
    mesh = head_of(document).mesh
    scalp = mesh.positions[mesh.vertex_attributes["scalp"] > 0.5]
    hair = strips_mesh(document, names=strip_names(document, ["hair"])).positions
    assert (KDTree(hair).query(scalp)[0] < REACH_M).mean() >= COVERED


@pytest.mark.parametrize("name", NAMES)
def test_surfaces_are_kept_and_not_shown(name):
    document = grown(name)
    surfaces = strip_names(document, ["surfaces"])
    assert surfaces and "surfaces" not in evaluate(document).meshes
    assert all(group in document.records for group in (each.removesuffix("_surface") for each in surfaces))


@pytest.mark.parametrize("name", NAMES)
def test_it_comes_back_from_usd(name, tmp_path):
    save_document(grown(name), tmp_path / "hair.usdc")
    assert open_document(tmp_path / "hair.usdc") == grown(name)


@pytest.mark.parametrize("name", NAMES)
def test_the_same_seed_gives_the_same_bits_and_another_one_other_hair(name):
    grow = next(preset.grow for preset in PRESETS if preset.name == name)
    bare = Document({"head": head_of(grown("bob_bangs"))})
    least = CartoonParams(clumps=0.4)
    assert grow(bare, least) == grow(bare, least)
    assert grow(bare, least) != grow(bare, CartoonParams(clumps=0.4, seed=1))


@pytest.mark.parametrize("name", NAMES)
def test_clumps_are_closed_and_pointed(name):
    document = grown(name)
    for strip_name in strip_names(document, ["hair"]):
        strip = document.records[strip_name]
        assert isinstance(strip, Strip)
        if strip.group != "cap":
            assert np.abs(strip.points[:, 0] - strip.points[:, -1]).max() < 1e-9
            assert np.ptp(strip.points[-1], axis=0).max() < 0.05


def test_wind_moves_every_long_clump_and_repeats():
    document = grown("long_wind")
    moved = {item.target for item in document.of_type(Keyframes).values() if item.kind == "position"}
    assert moved == {*strip_names(document, ["under"]), *strip_names(document, ["over"])}
    assert all(item.loop for item in document.of_type(Keyframes).values())


def test_an_unknown_preset_gets_one_error_with_the_choices():
    with pytest.raises(InputError, match=r"'ponytale'; did you mean ponytail\? one of ponytail, .* was expected"):
        hairdo("ponytale")
