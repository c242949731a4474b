"""Mesh queries: closed forms, refusals at the border, the head's open neck in small (a sphere without its bottom)."""

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.kernel import geom

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
CUBE_TRIANGLES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
    + [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)


def test_signed_distance_of_a_cube_is_its_closed_form():
    queries = np.random.default_rng(1).uniform(-0.7, 1.7, (500, 3))
    q = np.abs(queries - 0.5) - 0.5
    exact = np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)
    found = geom.signed_distances(CUBE, triangles=CUBE_TRIANGLES, queries=queries)
    assert np.allclose(found.distance, exact, atol=1e-12)
    gap = np.linalg.norm(found.points(CUBE, triangles=CUBE_TRIANGLES) - queries, axis=1)
    assert np.allclose(gap, np.abs(exact), atol=1e-12)


def test_a_cube_without_a_side_still_has_an_inside():
    open_cube = CUBE_TRIANGLES[2:]
    inside = geom.signed_distances(CUBE, triangles=open_cube, queries=[[0.5, 0.5, 0.5], [0.1, 0.9, 0.9]])
    outside = geom.winding_numbers(CUBE, triangles=open_cube, queries=[[-0.5, 0.5, 0.5], [0.5, 0.5, 1.2]])
    assert (inside.distance < 0).all()
    assert (outside < 0.5).all()


def test_rays_through_a_cube():
    origins = np.array([[-1, 0.3, 0.4], [-1, 0.3, 0.4], [-1, 1.3, 0.4]])
    directions = np.array([[2.0, 0, 0], [-1, 0, 0], [1, 0, 0]])
    hits = geom.ray_hits(CUBE, triangles=CUBE_TRIANGLES, origins=origins, directions=directions)
    assert hits.t.tolist() == [0.5, np.inf, np.inf]
    assert (hits.triangle >= 0).tolist() == [True, False, False]
    blocked = geom.rays_blocked(CUBE, triangles=CUBE_TRIANGLES, origins=origins, directions=directions, limit=0.4)
    assert blocked.tolist() == [False, False, False]


def test_attributes_at_closest_points_are_linear():
    queries = np.random.default_rng(2).uniform(0, 1, (50, 3))
    found = geom.closest_points(CUBE, triangles=CUBE_TRIANGLES, queries=queries)
    heights = geom.barycentric_values(
        CUBE[:, 1], triangles=CUBE_TRIANGLES, triangle=found.triangle, barycentric=found.barycentric
    )
    assert np.allclose(heights, found.points(CUBE, triangles=CUBE_TRIANGLES)[:, 1])


@pytest.mark.parametrize(
    ("positions", "triangles", "message"),
    [
        (CUBE[:, :2], CUBE_TRIANGLES, r"positions has shape \(8, 2\)"),
        (CUBE, [[0, 1, 8]], "names vertex 8 of 8"),
        (CUBE, [[0, 1, -1]], "triangles holds -1 to 1"),
        (CUBE, [[0.0, 1.0, 2.0]], "whole numbers"),
        (CUBE * np.nan, CUBE_TRIANGLES, "not finite"),
        (CUBE, np.zeros((0, 3), int), "no triangles"),
    ],
)
def test_wrong_meshes_are_refused(positions, triangles, message):
    with pytest.raises(InputError, match=message):
        geom.closest_points(positions, triangles=triangles, queries=[[0, 0, 0]])
