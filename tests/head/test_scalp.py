"""Roots on the scalp."""

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.head.scalp import scalp_roots, subdivided_triangle, vertex_normals
from tress.head.statistical import load_statistical_head

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])


def test_pieces_tile_the_triangle() -> None:
    pieces = subdivided_triangle(3)
    assert len(pieces) == 64
    edge_a, edge_b = pieces[:, 1, :2] - pieces[:, 0, :2], pieces[:, 2, :2] - pieces[:, 0, :2]
    areas = (edge_a[:, 0] * edge_b[:, 1] - edge_a[:, 1] * edge_b[:, 0]) / 2
    assert areas == pytest.approx(np.full(64, 0.5 / 64))
    assert pieces.sum(axis=2) == pytest.approx(np.ones((64, 3)))


def test_roots_are_as_dense_as_the_mask_says() -> None:
    mask = np.array([0.0, 1.0, 1.0, 0.0])
    roots = scalp_roots(SQUARE, triangles=FACES, scalp=mask, count=20_000, seed=1, subdivisions=4)
    x = roots.positions[:, 0]
    expected = np.arange(10) * 0.02 + 0.01
    assert np.histogram(x, bins=10, range=(0, 1))[0] / 20_000 == pytest.approx(expected, abs=0.005)
    assert roots.normals == pytest.approx(np.tile([0, 0, 1.0], (20_000, 1)))


def test_roots_are_where_their_triangle_says_and_repeat_by_seed() -> None:
    head = load_statistical_head()
    one, again, other = (
        scalp_roots(head.mean, triangles=head.triangles, scalp=head.masks["scalp"], count=3000, seed=seed)
        for seed in (5, 5, 6)
    )
    places = np.einsum("nk,nkd->nd", one.barycentric, head.mean[head.triangles[one.triangle]])
    assert places == pytest.approx(one.positions, abs=1e-7)
    assert np.array_equal(one.positions, again.positions)
    assert not np.array_equal(one.positions, other.positions)
    on_mask = np.einsum("nk,nk->n", one.barycentric, head.masks["scalp"][head.triangles[one.triangle]])
    assert (on_mask > 0.05).mean() > 0.97
    outwards = np.einsum("nd,nd->n", one.normals, one.positions - [0, 0.02, 0])
    assert (outwards > 0).mean() > 0.99


def test_roots_are_more_even_than_chance() -> None:
    roots = scalp_roots(SQUARE, triangles=FACES, scalp=np.ones(4), count=6400, seed=2, subdivisions=5)
    cells = np.histogram2d(roots.positions[:, 0], roots.positions[:, 1], bins=8, range=[[0, 1], [0, 1]])[0]
    assert cells.var() < 0.5 * cells.mean()


def test_an_empty_mask_is_refused() -> None:
    with pytest.raises(InputError, match="empty"):
        scalp_roots(SQUARE, triangles=FACES, scalp=np.zeros(4), count=10, seed=1)


def test_normals_of_a_square_point_up() -> None:
    assert vertex_normals(SQUARE, triangles=FACES) == pytest.approx(np.tile([0, 0, 1.0], (4, 1)))
