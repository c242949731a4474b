"""Mip chains: coverage is kept, cells stay apart, maps keep their meaning."""

from dataclasses import replace

import numpy as np
import pytest

from tress.base.color import srgb_to_linear
from tress.base.errors import InputError
from tress.base.report import Report
from tress.kernel.alpha_coverage import alpha_coverage
from tress.model.atlas import Atlas
from tress.render.textures.encode import directions
from tress.render.textures.layout import card_layout
from tress.render.textures.level_resolution import atlas_of_resolution, level_resolution, resolutions_of_budgets
from tress.render.textures.mip_chain import clear_levels, mip_chain
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_atlas import strand_atlas

PARAMS = TextureParams(resolution=512, variations=5, padding=8, aspect=3)
PADDING = PARAMS.padding


@pytest.fixture(scope="module")
def atlas():
    return strand_atlas(PARAMS, report=Report())


@pytest.fixture(scope="module")
def layout():
    return card_layout(PARAMS.variations, width=512, aspect=PARAMS.aspect, padding=PADDING)


@pytest.fixture(scope="module")
def chain(atlas):
    return mip_chain(atlas, padding=PADDING, threshold=0.5)


def cell(pixels, layout, card, level):
    rows, columns = layout.cell(card)
    return pixels[rows.start >> level : rows.stop >> level, columns.start >> level : columns.stop >> level]


def box_halved(alpha):
    return alpha.reshape(alpha.shape[0] // 2, 2, alpha.shape[1] // 2, 2).mean(axis=(1, 3))


def test_the_chain_goes_down_while_cards_stay_apart(atlas, chain):
    """Padding of 8 px is half a texel of 16 px: levels 0 to 4."""
    assert len(chain) == clear_levels(atlas, padding=PADDING) == 5
    assert [level.atlas.color.shape[1] for level in chain] == [512, 256, 128, 64, 32]
    assert chain[0].atlas is atlas


@pytest.mark.parametrize("threshold", [0.33, 0.5, 0.66])
def test_every_card_keeps_its_coverage_within_two_percent(atlas, threshold):
    levels = mip_chain(atlas, padding=PADDING, threshold=threshold)
    for level in levels[1:]:
        np.testing.assert_allclose(level.coverage, levels[0].coverage, rtol=0.02)


def test_coverage_is_measured_on_the_picture_as_a_whole_too(chain):
    shares = [alpha_coverage(level.atlas.color[..., 3] / 255, threshold=0.5) for level in chain]
    np.testing.assert_allclose(shares, shares[0], rtol=0.02)


def test_plain_averages_would_thin_the_sparsest_card_out(atlas, layout, chain):
    """The reason for all this: without the scale the last card loses more than a third on the way."""
    alpha = cell(atlas.color[..., 3], layout, 4, 0) / 255
    for _ in chain[1:]:
        alpha = box_halved(alpha)
    assert alpha_coverage(alpha, threshold=0.5) < 0.65 * chain[0].coverage[4]
    assert chain[-1].scale[4] > 1.2


def test_what_lies_in_one_cell_does_not_reach_another(atlas, layout, chain):
    color = np.array(atlas.color)
    color[layout.cell(2)] = 255
    changed = mip_chain(replace(atlas, color=color), padding=PADDING, threshold=0.5)
    for level, (before, after) in enumerate(zip(chain, changed, strict=True)):
        for card in (0, 1, 3, 4):
            assert (cell(before.atlas.color, layout, card, level) == cell(after.atlas.color, layout, card, level)).all()


def test_lookups_in_a_region_stay_within_its_cell(atlas, layout, chain):
    """A bilinear lookup at the region's edge reaches the texels half a texel further out."""
    for level in range(len(chain)):
        height, width = (side >> level for side in atlas.color.shape[:2])
        for card, (u_low, v_low, u_high, v_high) in enumerate(atlas.regions.astype(float)):
            rows, columns = (slice(part.start >> level, part.stop >> level) for part in layout.cell(card))
            assert u_low * width - 0.5 >= columns.start and u_high * width + 0.5 <= columns.stop
            assert (1 - v_high) * height - 0.5 >= rows.start and (1 - v_low) * height + 0.5 <= rows.stop


def test_texels_within_the_padding_are_empty_on_every_level(layout, chain):
    for level, mip in enumerate(chain[: PADDING.bit_length()]):
        pad = PADDING >> level
        for card in range(PARAMS.variations):
            alpha = np.array(cell(mip.atlas.color[..., 3], layout, card, level))
            alpha[pad:-pad, pad:-pad] = 0
            assert not alpha.any()


def test_no_fringe_colours_stay_between_those_of_the_strands(atlas, layout, chain):
    for level, mip in enumerate(chain):
        for card in range(PARAMS.variations):
            base = cell(atlas.color, layout, card, 0)
            own = base[base[..., 3] > 0][:, :3]
            seen = cell(mip.atlas.color, layout, card, level)[..., :3].reshape(-1, 3)
            assert (seen.min(axis=0) >= own.min(axis=0)).all() and (seen.max(axis=0) <= own.max(axis=0)).all()


def test_the_mean_colour_of_a_card_is_kept(layout, atlas, chain):
    """Box filters keep the alpha-weighted mean; the scale of alpha and bytes may shift it a little."""
    for card in range(3):
        means = []
        for level in (0, 2):
            rgba = cell(chain[level].atlas.color, layout, card, level)
            weight = rgba[..., 3:] / 255
            means.append((srgb_to_linear(rgba[..., :3]) * weight).sum(axis=(0, 1)) / weight.sum())
        np.testing.assert_allclose(means[1], means[0], rtol=0.05)


def test_directions_stay_unit_and_ids_stay_ids(layout, atlas, chain):
    for level, mip in enumerate(chain):
        for card in range(PARAMS.variations):
            for name in ("normal", "flow"):
                length = np.linalg.norm(directions(cell(mip.atlas.maps[name], layout, card, level)), axis=-1)
                assert np.abs(length - 1).max() < 0.5 * np.sqrt(3) / 127
            known = np.unique(cell(atlas.maps["strand_id"], layout, card, 0))
            assert set(np.unique(cell(mip.atlas.maps["strand_id"], layout, card, level))) <= set(known)


@pytest.mark.parametrize(
    ("regions", "padding"),
    [
        ([[0.1, 0.1, 0.9, 0.9]], 2),
        ([[0.0, 0.25, 0.75, 0.75]], 2),
        ([[0.125, 0.125, 0.5, 0.875], [0.5, 0.125, 0.875, 0.875]], 2),
    ],
)
def test_regions_that_are_no_cells_are_refused(regions, padding):
    atlas = Atlas(color=np.zeros((32, 32, 4), np.uint8), regions=np.array(regions, np.float32))
    with pytest.raises(InputError):
        mip_chain(atlas, padding=padding, threshold=0.5)


def test_empty_cards_stay_empty():
    atlas = Atlas(color=np.zeros((32, 32, 4), np.uint8), regions=np.array([[0.25, 0.25, 0.75, 0.75]], np.float32))
    assert all(not level.atlas.color.any() for level in mip_chain(atlas, padding=8, threshold=0.5))


def test_resolution_follows_the_budget(chain):
    assert resolutions_of_budgets([88, 35, 12], resolution=1024) == (1024, 512, 512)
    assert level_resolution(1024, size_on_screen=7.0) == 1024
    assert level_resolution(1024, size_on_screen=1e-6) == 16
    assert atlas_of_resolution(chain, resolution=200).color.shape[1] == 256
    assert atlas_of_resolution(chain, resolution=4096) is chain[0].atlas
    for wrong in ([], [100, 0]):
        with pytest.raises(InputError):
            resolutions_of_budgets(wrong, resolution=1024)


@pytest.mark.parametrize("size", [1.0, 0.71, 0.5, 0.3, 0.13])
def test_texels_keep_their_size_on_the_screen(size):
    assert 2**-0.5 <= level_resolution(2048, size_on_screen=size) / (2048 * size) <= 2**0.5
