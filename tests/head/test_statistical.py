"""What the built head promises."""

import numpy as np
import pytest

from tress.head.statistical import load_statistical_head

HEAD = load_statistical_head()


def edges_of(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return np.unique(pairs, axis=0, return_counts=True)


def test_the_neck_is_the_skins_only_boundary() -> None:
    skin = HEAD.triangles[(HEAD.triangles < HEAD.skin_count).all(axis=1)]
    edges, count = edges_of(skin)
    assert count.max() == 2
    rim = np.unique(edges[count == 1])
    assert (HEAD.masks["neck"][rim] == 1).all()
    assert HEAD.skin_count - len(edges) + len(skin) == 1


def test_eyeballs_are_closed() -> None:
    balls = HEAD.triangles[(HEAD.triangles >= HEAD.skin_count).any(axis=1)]
    assert (balls >= HEAD.skin_count).all()
    assert (edges_of(balls)[1] == 2).all()


def test_triangles_face_outwards() -> None:
    corners = HEAD.mean[HEAD.triangles[(HEAD.triangles < HEAD.skin_count).all(axis=1)]]
    rim_closed_volume = np.einsum("fd,fd->f", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert 2e-3 < rim_closed_volume < 7e-3


def test_the_mean_is_symmetric_upright_and_of_human_size() -> None:
    mirrored = HEAD.mean[HEAD.mirror] * [-1, 1, 1]
    assert np.linalg.norm(mirrored - HEAD.mean, axis=1).mean() < 1e-3
    assert HEAD.center(HEAD.mean) == pytest.approx(np.zeros(3), abs=1e-3)
    crown, chin, forehead, occiput = HEAD.mean[HEAD.extremes]
    assert 0.19 < crown[1] - chin[1] < 0.25
    assert 0.17 < forehead[2] - occiput[2] < 0.22
    right, left = HEAD.eyes(HEAD.mean)
    assert 0.055 < left[0] - right[0] < 0.07
    assert min(right[2], left[2]) > 0.03


def test_masks_name_the_right_places() -> None:
    masks = HEAD.masks
    assert all(mask.min() >= 0 and mask.max() <= 1 for mask in masks.values())
    crown, chin, _, occiput = HEAD.extremes
    assert masks["scalp"][crown] == masks["scalp"][occiput] == 1
    assert masks["scalp"][chin] == masks["neck"][chin] == 0
    assert (masks["scalp"] * masks["neck"]).max() < 0.1
    assert np.abs(HEAD.mean[masks["ears"] > 0.5, 0]).min() > 0.05
    for mask in masks.values():
        assert np.abs(mask - mask[HEAD.mirror]).mean() < 0.02


def test_landmarks_lie_where_their_names_say() -> None:
    points = HEAD.at_landmarks(HEAD.mean)
    right, left = HEAD.eyes(HEAD.mean)
    assert np.linalg.norm(points[[33, 133]].mean(axis=0) - right) < 0.02
    assert np.linalg.norm(points[[263, 362]].mean(axis=0) - left) < 0.02
    assert np.linalg.norm(points[152] - HEAD.mean[HEAD.extremes[1]]) < 0.02
    assert points[:, 2].argmax() in {1, 4, 5, 19, 44, 45, 274, 275}
    mirrored = points[HEAD.landmark_mirror] * [-1, 1, 1]
    assert np.linalg.norm(mirrored - points, axis=1).max() < 0.004
    assert HEAD.masks["inside"][HEAD.triangles[HEAD.landmark_triangle]].max() < 1


def test_uv_covers_the_square_without_overlap() -> None:
    uv = HEAD.corner_uv.astype(float)
    assert uv.min() >= 0
    assert uv.max() <= 1
    first, second = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    area = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2
    assert (area > 0).mean() > 0.999 or (area < 0).mean() > 0.999


def test_a_smile_moves_the_lips_and_nothing_behind_the_ears() -> None:
    smile = np.array([float(name.startswith("mouthSmile")) for name in HEAD.expression_names])
    moved = np.linalg.norm(HEAD.positions(expression=smile) - HEAD.mean, axis=1)
    assert smile.sum() == 2
    assert moved[HEAD.masks["lips"] > 0.5].max() > 0.003
    assert moved[(HEAD.mean[:, 2] < -0.03)].max() < 1e-3
