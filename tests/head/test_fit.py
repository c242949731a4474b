"""Fitting: laws on heads whose landmarks are known, and the astronaut."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.head.faces import astronaut, exact_landmarks, photographed, random_pose
from tress.head.cranium import cranium_weight
from tress.head.definite import solve_definite
from tress.head.fit import FitParams, FittedHead, doubts, fit_head
from tress.head.landmarks import landmarks_of
from tress.head.person import person_mask
from tress.head.pose import Pose, similarity_pose
from tress.head.read_face import read_face
from tress.head.statistical import load_statistical_head

HEAD = load_statistical_head()


def silhouette(fitted: FittedHead, height: int, width: int) -> np.ndarray:
    corners = np.round(fitted.project(fitted.positions_in_view)[fitted.triangles]).astype(np.int32)
    out = np.zeros((height, width), np.uint8)
    for corner in corners:
        cv2.fillConvexPoly(out, corner.reshape(-1, 1, 2), 1)
    return out


@given(st.integers(0, 10_000))
@settings(max_examples=15, deadline=None)
def test_exact_landmarks_of_the_mean_give_back_the_pose(seed: int) -> None:
    pose = random_pose(np.random.default_rng(seed))
    fitted = fit_head(exact_landmarks(HEAD, HEAD.mean, pose))
    turn = fitted.view_from_head[:3, :3] @ pose.rotation.T
    angle = np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1))
    assert np.degrees(angle) < 1.0
    assert fitted.px_per_metre == pytest.approx(pose.scale, rel=0.01)
    assert fitted.error_of_eye_distance < 0.005
    assert (fitted.yaw, fitted.pitch, fitted.roll) == pytest.approx((pose.yaw, pose.pitch, pose.roll), abs=0.02)


@given(st.integers(0, 10_000))
@settings(max_examples=10, deadline=None)
def test_exact_landmarks_of_a_random_head_are_met(seed: int) -> None:
    rng = np.random.default_rng(seed)
    positions = HEAD.positions(shape=rng.standard_normal(20) * 0.7, expression=rng.uniform(0, 0.3, 38))
    pose = random_pose(rng)
    fitted = fit_head(exact_landmarks(HEAD, positions, pose), params=FitParams(noise=0.001, rounds=12))
    turn = fitted.view_from_head[:3, :3] @ pose.rotation.T
    assert np.degrees(np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1))) < 6
    assert fitted.error_of_eye_distance < 0.02


@given(st.integers(0, 10_000), st.floats(0.6, 4.0))
@settings(max_examples=15, deadline=None)
def test_the_whole_head_lies_where_a_pinhole_sees_it(seed: int, distance: float) -> None:
    pose = random_pose(np.random.default_rng(seed))
    landmarks = exact_landmarks(HEAD, HEAD.mean, pose, distance=distance)
    fitted = fit_head(landmarks, params=FitParams(camera_distance=distance))
    skull = HEAD.masks["scalp"] > 0.5
    away = fitted.project(fitted.positions_in_view) - photographed(HEAD.mean, pose, distance=distance)
    assert np.linalg.norm(away[skull], axis=1).mean() < 0.0025 * pose.scale


def test_without_perspective_the_cranium_would_come_out_too_large() -> None:
    pose = Pose(np.eye(3), 2000.0, np.array([500.0, 450.0, 0.0]))
    landmarks = exact_landmarks(HEAD, HEAD.mean, pose, distance=2.0)
    side = (HEAD.masks["scalp"] > 0.5) & (np.abs(HEAD.mean[:, 0]) > 0.06)
    x_px = photographed(HEAD.mean, pose, distance=2.0)[side, 0] - 500

    def growth(distance: float) -> float:
        fitted = fit_head(landmarks, params=FitParams(camera_distance=distance))
        seen_px = fitted.project(fitted.positions_in_view)[side, 0] - 500
        return float(np.median(seen_px / x_px) - 1)

    assert growth(2.0) == pytest.approx(0, abs=0.005)
    assert growth(1000.0) > 0.02


def test_frames_agree() -> None:
    pose = random_pose(np.random.default_rng(4))
    fitted = fit_head(exact_landmarks(HEAD, HEAD.mean, pose))
    assert HEAD.center(fitted.positions_in_head) == pytest.approx(np.zeros(3), abs=1e-9)
    back = fitted.positions_in_head @ fitted.view_from_head[:3, :3].T
    assert back == pytest.approx(fitted.positions_in_view)
    assert np.linalg.det(fitted.view_from_head) == pytest.approx(1)
    assert fitted.xy_from_view[0, 0] == pytest.approx(-fitted.xy_from_view[1, 1])
    seen = fitted.project(HEAD.at_landmarks(fitted.positions_in_view))
    assert np.linalg.norm(seen - fitted.landmarks.points[:, :2], axis=1).mean() < 0.01 * fitted.inter_ocular_px


def test_mirrored_landmarks_give_a_mirrored_head() -> None:
    landmarks = exact_landmarks(HEAD, HEAD.mean, random_pose(np.random.default_rng(6)))
    mirrored = landmarks_of(landmarks.points[HEAD.landmark_mirror] * [-1, 1, 1] + [1000, 0, 0])
    one, other = fit_head(landmarks), fit_head(mirrored)
    assert other.yaw == pytest.approx(-one.yaw, abs=0.02)
    assert other.pitch == pytest.approx(one.pitch, abs=0.02)
    back = other.positions_in_view[HEAD.mirror] * [-1, 1, 1]
    assert np.linalg.norm(back - one.positions_in_view, axis=1).mean() < 0.003


def test_the_closed_form_pose_is_exact_for_exact_points() -> None:
    pose = random_pose(np.random.default_rng(8))
    points = HEAD.at_landmarks(HEAD.mean)
    found = similarity_pose(points, pose.seen(points), weight=np.ones(len(points)))
    assert found.rotation == pytest.approx(pose.rotation)
    assert found.scale == pytest.approx(pose.scale)
    assert found.offset == pytest.approx(pose.offset)


def test_a_cranium_outside_the_person_mask_is_pulled_in_and_the_face_stays() -> None:
    landmarks = exact_landmarks(HEAD, HEAD.mean, random_pose(np.random.default_rng(11)))
    free = fit_head(landmarks)
    crown = free.project(free.positions_in_view[HEAD.extremes[0]])
    mask = silhouette(free, 1000, 1000).astype(np.float32)
    cut = round(float(crown[1]) + 0.012 * free.px_per_metre)
    mask[:cut] = 0
    held = fit_head(landmarks, person_mask=mask)
    scalp = HEAD.masks["scalp"] > 0.5

    def above_cut(fitted: FittedHead) -> float:
        return float((cut - fitted.project(fitted.positions_in_view[scalp])[:, 1]).max() / fitted.px_per_metre)

    assert above_cut(free) > 0.010
    assert above_cut(held) < 0.006
    assert held.error_of_eye_distance < 0.02


def test_a_mask_far_larger_than_the_head_changes_nothing() -> None:
    landmarks = exact_landmarks(HEAD, HEAD.mean, random_pose(np.random.default_rng(12)))
    held = fit_head(landmarks, person_mask=np.ones((1000, 1000), np.float32))
    assert np.array_equal(held.positions_in_view, fit_head(landmarks).positions_in_view)


def test_the_user_scales_the_cranium_and_the_face_stays() -> None:
    landmarks = exact_landmarks(HEAD, HEAD.mean, random_pose(np.random.default_rng(13)))
    one = fit_head(landmarks).positions_in_head
    other = fit_head(landmarks, params=FitParams(cranium_scale=1.1, cranium_tilt=0.1)).positions_in_head
    moved = np.linalg.norm(other - one, axis=1)
    still = cranium_weight(HEAD) == 0
    assert moved[still].max() < 1e-9
    assert (HEAD.masks["lips"][~still] == 0).all()
    assert other[HEAD.extremes[0], 1] - one[HEAD.extremes[0], 1] > 0.004


def test_the_astronaut_fits_within_three_percent() -> None:
    image = astronaut()
    landmarks = read_face(image)
    fitted = fit_head(landmarks, person_mask=person_mask(image, landmarks=landmarks))
    assert fitted.error_of_eye_distance < 0.03
    assert abs(np.degrees(fitted.yaw)) < 8
    assert doubts(fitted) == []


def test_a_profile_is_fitted_with_a_doubt() -> None:
    pose = similarity_pose(np.eye(3), np.eye(3) * [1, -1, 1], weight=np.ones(3))
    yaw = np.radians(55)
    turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    turned = type(pose)(turn, 2000.0, np.array([500.0, 500.0, 0.0]))
    fitted = fit_head(exact_landmarks(HEAD, HEAD.mean, turned))
    assert np.degrees(fitted.yaw) == pytest.approx(55, abs=2)
    assert "turned by 5" in doubts(fitted)[0]


@given(st.integers(1, 40), st.integers(0, 1000))
@settings(max_examples=30, deadline=None)
def test_definite_systems_are_solved_as_by_lapack(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    root = rng.standard_normal((count, count))
    matrix, values = root @ root.T + 0.1 * np.eye(count), rng.standard_normal(count)
    assert solve_definite(matrix, values) == pytest.approx(np.linalg.solve(matrix, values), rel=1e-6, abs=1e-8)
