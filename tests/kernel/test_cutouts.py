"""Triangles that one can see through: what a stack of layers shows, by closed form."""

import itertools

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.kernel.raster import Cutouts, rasterise

EMPTY = {
    "offsets": np.zeros(1, np.int64),
    "half_width_px": np.zeros(0, np.float32),
    "alpha": np.zeros(0, np.float32),
    "width": 4,
    "height": 4,
}
SQUARE = np.array([[0, 0], [4, 0], [4, 4], [0, 4]])
HALVES = np.array([[0, 1, 2], [0, 2, 3]])
UV = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], np.float32)


def quads(depths, alphas):
    """Fragments of 4 x 4 pixels under squares, each (depth at its corners, opacity 0 to 255 or None for opaque)."""
    count = len(depths)
    vertices = np.concatenate([np.c_[SQUARE, np.broadcast_to(depth, 4), np.ones(4)] for depth in depths])
    triangles = np.concatenate([HALVES + 4 * i for i in range(count)])
    through = [np.full((2, 2), alpha, np.uint8) for alpha in alphas if alpha is not None]
    number = iter(range(len(through)))
    of_triangle = np.repeat([-1 if alpha is None else next(number) for alpha in alphas], 2)
    cutouts = Cutouts(through, of_triangle, np.tile(UV[HALVES], (count, 1, 1)))
    return rasterise(np.zeros((0, 4)), mesh_vertices=vertices, triangles=triangles, cutouts=cutouts, **EMPTY)


def weights(fragments, *, squares):
    """(squares,) share of every square in all pixels, and how much it differs between them."""
    per_pixel = np.zeros((16, squares))
    np.add.at(per_pixel, (fragments.pixel, fragments.primitive // 2), fragments.weight)
    return per_pixel.mean(axis=0), np.ptp(per_pixel, axis=0).max()


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_layers_in_any_order_let_through_what_is_left(order):
    """Opacities a at 1, b at 2 before an opaque wall at 3: a, (1 - a) b, (1 - a)(1 - b)."""
    depths, alphas = (1, 2, 3), (102, 51, None)
    fragments = quads([depths[i] for i in order], [alphas[i] for i in order])
    found, spread = weights(fragments, squares=3)
    np.testing.assert_allclose(found[np.argsort(order)], [0.4, 0.6 * 0.2, 0.6 * 0.8], atol=1e-6)
    assert spread < 1e-6


def test_layers_that_cross_are_ordered_at_every_sample():
    """Two squares that cross in the middle column: each is the first in its half of the picture."""
    rising, falling = [1, 3, 3, 1], [3, 1, 1, 3]
    found, _ = weights(quads([rising, falling], [128, 128]), squares=2)
    a = 128 / 255
    np.testing.assert_allclose(found, (a + (1 - a) * a) / 2, atol=1e-6)


def test_a_layer_behind_a_wall_is_not_seen():
    found, _ = weights(quads([1, 2], [None, 200]), squares=2)
    np.testing.assert_array_equal(found, [1, 0])


def test_a_layer_without_opacity_is_not_there():
    assert len(quads([1], [0]).weight) == 0


def test_twenty_layers_leave_what_twenty_let_through_or_less_than_a_512th():
    found, _ = weights(quads([*range(20), 99], [77] * 20 + [None]), squares=21)
    assert found.sum() == pytest.approx(1, abs=1e-6)
    first = (77 / 255) * (1 - 77 / 255) ** np.arange(8)
    np.testing.assert_allclose(found[:8], first, atol=1e-6)


def test_opacity_is_read_bilinearly_and_its_upper_row_lies_at_v_1():
    picture = np.array([[255], [0]], np.uint8)
    vertices = np.c_[SQUARE, np.zeros(4), np.ones(4)]
    cutouts = Cutouts([picture], np.zeros(2, int), UV[HALVES])
    found = rasterise(np.zeros((0, 4)), mesh_vertices=vertices, triangles=HALVES, cutouts=cutouts, **EMPTY)
    row = np.bincount(found.pixel // 4, weights=found.weight, minlength=4) / 4
    # Rows at v from 1 down: opaque to 3/4, then falling linearly to nothing at 1/4.
    np.testing.assert_allclose(row, [1, 0.75, 0.25, 0], atol=0.01)


def test_texture_coordinates_are_right_in_perspective():
    """A square whose lower edge is three times as far: half-way down the screen one is a quarter along it."""
    vertices = np.c_[SQUARE, np.zeros(4), [3, 3, 1, 1]]
    ramp = np.repeat(np.linspace(255, 0, 256)[:, None], 2, axis=1).astype(np.uint8)
    cutouts = Cutouts([ramp], np.zeros(2, int), UV[HALVES])
    found = rasterise(np.zeros((0, 4)), mesh_vertices=vertices, triangles=HALVES, cutouts=cutouts, **EMPTY)
    row = np.bincount(found.pixel // 4, weights=found.weight, minlength=4) / 4
    y = (np.arange(400) + 0.5) / 400
    v = (1 - y) * 3 / ((1 - y) * 3 + y)
    np.testing.assert_allclose(row, v.reshape(4, 100).mean(axis=1), atol=0.01)


def test_wrong_cutouts_are_refused():
    with pytest.raises(InputError, match="cutout_of_triangle has 1 entries; 2 were expected"):
        rasterise(
            np.zeros((0, 4)),
            mesh_vertices=np.c_[SQUARE, np.zeros(4), np.ones(4)],
            triangles=HALVES,
            cutouts=Cutouts([np.zeros((2, 2), np.uint8)], np.zeros(1, int), UV[HALVES]),
            **EMPTY,
        )
    with pytest.raises(InputError, match="triangle 1 names a picture"):
        rasterise(
            np.zeros((0, 4)),
            mesh_vertices=np.c_[SQUARE, np.zeros(4), np.ones(4)],
            triangles=HALVES,
            cutouts=Cutouts([np.zeros((2, 2), np.uint8)], np.arange(2), UV[HALVES]),
            **EMPTY,
        )
