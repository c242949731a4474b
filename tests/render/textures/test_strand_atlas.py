"""Atlases of strands: straight alpha, dilated borders, sameness, refusals."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial import cKDTree

from tress.base.errors import ParameterError
from tress.base.report import Report
from tress.render.textures.dilate import dilated
from tress.render.textures.encode import directions
from tress.render.textures.layout import card_layout
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_atlas import strand_atlas

SMALL = TextureParams(resolution=256, variations=5, padding=4, strands=70, aspect=3)


@pytest.fixture(scope="module")
def atlas():
    return strand_atlas(SMALL, report=Report())


@pytest.fixture(scope="module")
def layout():
    return card_layout(SMALL.variations, width=SMALL.resolution, aspect=SMALL.aspect, padding=SMALL.padding)


def test_transparent_texels_have_the_values_of_the_nearest_opaque_one_of_their_cell(atlas, layout):
    for card in range(SMALL.variations):
        rgba = atlas.color[layout.cell(card)]
        seen, empty = np.argwhere(rgba[..., 3] > 0), np.argwhere(rgba[..., 3] == 0)
        distance, _ = cKDTree(seen).query(empty)
        for place, reach in zip(empty[::97], distance[::97], strict=True):
            nearest = seen[np.linalg.norm(seen - place, axis=1) <= reach + 1e-9]
            assert (rgba[tuple(nearest.T)][:, :3] == rgba[tuple(place)][:3]).all(axis=1).any()


def test_alpha_is_straight(atlas):
    """Half-covered texels are as bright as fully covered ones; premultiplied ones would be half as bright."""
    alpha, light = atlas.color[..., 3], atlas.color[..., :3].mean(axis=-1)
    assert light[(alpha > 20) & (alpha < 110)].mean() > 0.8 * light[alpha == 255].mean()


def test_padding_is_empty(atlas, layout):
    outside = np.ones(atlas.color.shape[:2], bool)
    for card in range(SMALL.variations):
        rows, columns = layout.cell(card)
        pad = SMALL.padding
        outside[rows.start + pad : rows.stop - pad, columns.start + pad : columns.stop - pad] = False
    assert outside.any() and not atlas.color[outside][:, 3].any()


def test_regions_are_the_cards(atlas, layout):
    for card, (u_low, v_low, u_high, v_high) in enumerate(atlas.regions):
        rows, columns = layout.cell(card)
        assert u_low * layout.width == columns.start + SMALL.padding
        assert u_high * layout.width == columns.stop - SMALL.padding
        assert (1 - v_high) * layout.height == rows.start + SMALL.padding
        assert (1 - v_low) * layout.height == rows.stop - SMALL.padding


def test_directions_are_unit_everywhere_in_the_cells(atlas, layout):
    for name in ("normal", "flow"):
        for card in range(SMALL.variations):
            length = np.linalg.norm(directions(atlas.maps[name][layout.cell(card)]), axis=-1)
            assert np.abs(length - 1).max() < 0.5 * np.sqrt(3) / 127


def test_roots_are_dark_and_tips_light_as_the_colours_say(atlas, layout):
    light, along = atlas.color[..., 0].astype(float), atlas.maps["root_to_tip"]
    seen = atlas.color[..., 3] > 200
    assert light[seen & (along > 190)].mean() > 1.5 * light[seen & (along < 60)].mean()


def test_cards_get_sparser_from_kind_to_kind(atlas, layout):
    filled = [atlas.color[layout.cell(card)][..., 3].mean() for card in range(SMALL.variations)]
    assert filled[1:] == sorted(filled[1:], reverse=True) and filled[-1] < 0.4 * filled[0]


def test_seeds_and_variations_differ_and_the_same_seed_is_the_same(atlas, layout):
    again, other = (strand_atlas(replace(SMALL, seed=seed), report=Report()) for seed in (0, 1))
    assert again == atlas and other != atlas
    one_kind = strand_atlas(replace(SMALL, kinds=("wispy",)), report=Report())
    first, second = (one_kind.color[layout.cell(card)] for card in (0, 1))
    assert (first != second).any()


def test_any_number_of_threads_gives_the_same_bits(atlas):
    program = (
        "import hashlib; from test_strand_atlas import SMALL, strand_atlas, Report\n"
        "a = strand_atlas(SMALL, report=Report())\n"
        "print(hashlib.sha256(a.color.tobytes() + b''.join(a.maps[n].tobytes() for n in sorted(a.maps))).hexdigest())"
    )
    said = set()
    for threads in ("1", "3"):
        environment = {**os.environ, "RAYON_NUM_THREADS": threads, "PYTHONPATH": os.path.dirname(__file__)}
        ended = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True)
        assert ended.returncode == 0, ended.stderr
        said.add(ended.stdout)
    assert len(said) == 1


@settings(max_examples=40, deadline=None)
@given(arrays(np.uint8, st.tuples(st.integers(1, 12), st.integers(1, 12)), elements=st.sampled_from([0, 0, 1, 255])))
def test_dilation_takes_a_nearest_pixel(alpha):
    places = np.arange(alpha.size).reshape(alpha.shape)
    found = dilated({"place": places}, alpha=alpha)["place"]
    if not alpha.any():
        assert (found == places).all()
        return
    seen = np.argwhere(alpha > 0)
    taken = np.stack(np.unravel_index(found, alpha.shape), axis=-1)
    own = np.stack(np.indices(alpha.shape), axis=-1)
    least = np.linalg.norm(own[:, :, None] - seen, axis=-1).min(axis=-1)
    np.testing.assert_allclose(np.linalg.norm(own - taken, axis=-1), least)
    assert (alpha[tuple(np.moveaxis(taken, -1, 0))] > 0).all()


@pytest.mark.parametrize(("count", "aspect"), [(1, 4), (3, 2), (8, 4), (16, 6), (40, 1)])
def test_cells_tile_the_atlas_without_overlap(count, aspect):
    layout = card_layout(count, width=1024, aspect=aspect, padding=8)
    used = np.zeros((layout.height, layout.width), int)
    for card in range(count):
        used[layout.cell(card)] += 1
    assert used.max() == 1 and used.sum() == count * layout.cell_width * layout.cell_height
    assert abs(np.log(layout.aspect / aspect)) < np.log(2)


@pytest.mark.parametrize(
    "changes",
    [
        {"resolution": 1000},
        {"resolution": 64, "variations": 200},
        {"kinds": ("braid",)},
        {"kinds": ()},
        {"root_color": (0.1, 0.2)},
        {"tip_color": (0.1, 0.2, 1.5)},
        {"strands": 0},
        {"thickness": float("nan")},
        {"strands": 2.5},
    ],
)
def test_wrong_parameters_are_refused(changes):
    with pytest.raises(ParameterError):
        strand_atlas(replace(SMALL, **changes), report=Report())


@pytest.mark.parametrize(
    "changes",
    [
        {"strands": 1},
        {"frizz": 1.0, "clumping": 1.0, "length_variation": 1.0},
        {"tip_fade": 0.0, "root_fade": 0.0},
        {"tip_fade": 1.0, "root_fade": 0.5, "thickness": 0.2},
        {"resolution": 64, "padding": 1, "thickness": 0.001},
    ],
)
def test_extremes_still_give_cards(changes):
    atlas = strand_atlas(replace(SMALL, **changes), report=Report())
    assert atlas.color[..., 3].any()
