"""The small geometry of the asset builder against closed forms."""

import numpy as np
import pytest

from tools.assets.correspondence import far_outline, geometric_median, mirrored_points
from tools.assets.makehuman import parsed_mesh, parsed_target
from tools.assets.nearest import nearest_on_mesh
from tools.assets.shapes import aligned, principal_components, vertex_areas
from tools.assets.zbuffer import visible
from tress.head.landmarks import FACE_OVAL


def test_zbuffer_shows_the_nearer_of_two_squares() -> None:
    square = np.array([[0, 0], [8, 0], [8, 8], [0, 8.0]])
    points = np.concatenate([np.column_stack([square, np.zeros(4)]), np.column_stack([square / 2, np.ones(4)])])
    faces = np.array([[0, 3, 2], [0, 2, 1]])
    shown = visible(points, np.concatenate([faces, faces + 4]), size=8)
    assert (shown.triangle[:4, :4] >= 2).all()
    assert np.isin(shown.triangle[4:], (0, 1)).all()
    corners = points[np.concatenate([faces, faces + 4])[shown.triangle]][..., :2]
    middles = np.einsum("hwk,hwkd->hwd", shown.barycentric, corners)
    assert middles[5, 2] == pytest.approx([2.5, 5.5])


def test_zbuffer_shows_no_back_faces() -> None:
    points = np.array([[0, 0, 0], [8, 0, 0], [0, 8, 0.0]])
    assert (visible(points, np.array([[0, 1, 2]]), size=8).triangle == -1).all()


def test_nearest_point_lies_inside_on_an_edge_or_at_a_corner() -> None:
    positions = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])
    points = np.array([[0.2, 0.3, 5.0], [0.5, -2.0, 0.0], [3.0, -1.0, 0.0]])
    _, weights = nearest_on_mesh(points, positions, np.array([[0, 1, 2]]))
    assert weights @ positions == pytest.approx(np.array([[0.2, 0.3, 0], [0.5, 0, 0], [1, 0, 0]]))


def test_geometric_median_ignores_a_wild_minority() -> None:
    points = np.concatenate([np.zeros((7, 3)), np.full((3, 3), 100.0), np.full((2, 3), np.nan)])
    assert geometric_median(points, rounds=100) == pytest.approx(np.zeros(3), abs=1e-3)


def test_mirrored_points_pair_left_and_right() -> None:
    points = np.array([[1, 0, 0], [0, 2, 0], [-1, 0, 0], [-3, 1, 1], [3.1, 1, 1]])
    assert mirrored_points(points).tolist() == [2, 1, 0, 4, 3]


def test_far_outline_is_one_side_or_none() -> None:
    assert far_outline(0.05) == []
    left, right = set(far_outline(0.5)), set(far_outline(-0.5))
    assert not left & right
    assert left | right == set(FACE_OVAL) - {10, 152}


def test_alignment_removes_turn_place_and_size() -> None:
    rng = np.random.default_rng(1)
    shape = rng.standard_normal((30, 3))
    turn = np.linalg.qr(rng.standard_normal((5, 3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))[:, None, None]
    heads = rng.uniform(0.5, 2, (5, 1, 1)) * shape @ turn * 0.1 + rng.standard_normal((5, 1, 3))
    heads[:, :, :] = heads
    small = heads[:1] + 0.01 * (heads - heads[:1])
    result = aligned(small.astype(np.float32), np.ones(30))
    assert np.abs(result - result.mean(axis=0)).max() < 0.02 * np.abs(result).max()


def test_components_restore_what_they_were_made_of() -> None:
    rng = np.random.default_rng(2)
    basis = rng.standard_normal((3, 12, 3))
    heads = (rng.standard_normal((50, 3)) @ basis.reshape(3, -1)).reshape(50, 12, 3).astype(np.float32)
    model = principal_components(heads, np.ones(12), count=3)
    assert model.variance.sum() == pytest.approx(1)
    flat = (heads - model.mean).reshape(50, -1)
    components = model.components.reshape(3, -1)
    scores = flat @ np.linalg.pinv(components)
    assert scores @ components == pytest.approx(flat, abs=1e-5)
    assert scores.std(axis=0) == pytest.approx(np.ones(3), abs=1e-4)


def test_vertex_areas_sum_to_the_area() -> None:
    square = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0.0]])
    assert vertex_areas(square, np.array([[0, 1, 2], [0, 2, 3]])).sum() == pytest.approx(4)


def test_mesh_and_target_are_read_in_metres() -> None:
    mesh = parsed_mesh("v 1 2 3\nv 0 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 1\ng body\nf 1/1 2/2 3/1 4/2\n")
    assert mesh.positions[0] == pytest.approx([0.1, 0.2, 0.3])
    assert mesh.quads["body"].tolist() == [[[0, 0], [1, 1], [2, 0], [3, 1]]]
    target = parsed_target(b"# note\n5 .1 0 -1\n")
    assert target.vertices.tolist() == [5]
    assert target.offsets == pytest.approx(np.array([[0.01, 0, -0.1]]))
