"""Depth of traced strands: the layers of crossing strands, and the constraints of the energy."""

import numpy as np
import pytest
from methods.small_head import SIZE, Curves, ball, hair_alpha

from tress.base.report import Report
from tress.methods.portrait.depth import DepthParams, depth

GAP = 0.008


def crossing(*, hidden: int) -> Curves:
    """A strand across the hair and one down through it, `hidden` of whose vertices lie under the first."""
    across = np.stack([np.linspace(70, 130, 81), np.full(81, 60.0)], axis=1)
    down = np.stack([np.full(31, 100.0), np.linspace(49, 71, 31)], axis=1)
    occluded = np.zeros(112, bool)
    occluded[81 + 15 - hidden // 2 : 81 + 16 + hidden // 2] = hidden > 0
    return Curves(np.concatenate([across, down]), np.array([0, 81, 112]), occluded)


def depths(curves: Curves, **settings: float) -> np.ndarray:
    params = DepthParams(**{"every": 1, "layer_gap": GAP, "layer_rounds": 8, **settings})
    solid = np.zeros((SIZE, SIZE), bool)
    return depth(curves, head=ball(), alpha=hair_alpha(), solid=solid, params=params, report=Report()).z


@pytest.mark.parametrize("every", [1, 3])
def test_a_hidden_vertex_lies_behind_the_strand_that_crosses_over_it(every):
    curves = crossing(hidden=4)
    free, layered = depths(curves, layer_rounds=0, every=every), depths(curves, every=every)
    over, under = 40, 81 + 15
    assert abs(free[over] - free[under]) < 0.3 * GAP
    assert layered[over] - layered[under] > 0.7 * GAP


def test_a_strand_is_no_layer_over_itself():
    """The vertices next to a hidden one are its own strand's; without another strand nothing holds it down."""
    whole = crossing(hidden=4)
    alone = Curves(whole.points[81:], np.array([0, 31]), whole.occluded[81:])
    np.testing.assert_array_equal(depths(alone), depths(alone, layer_rounds=0))


def test_strands_that_nothing_hides_are_not_pushed_apart():
    np.testing.assert_array_equal(depths(crossing(hidden=0)), depths(crossing(hidden=0), layer_rounds=0))
