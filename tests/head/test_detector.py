"""Face detection: the parts against closed forms, the whole on photographs."""

import numpy as np
import pytest

from tests.head.faces import astronaut
from tress.head.detector import OpenCvFaceDetector, anchors, find_faces, intersection_over_union, merge_votes
from tress.head.face_mesh import OpenCvLandmarkModel, locate_landmarks


def votes(*boxes: tuple[float, float, float, float]) -> np.ndarray:
    return np.array([[[x, y], [w, h], *[[x, y]] * 6] for x, y, w, h in boxes])


def test_anchors_are_the_cells_middles() -> None:
    centers = anchors()
    assert centers.shape == (896, 2)
    assert centers[:2].tolist() == [[1 / 32, 1 / 32]] * 2
    assert centers[512:518].tolist() == [[1 / 16, 1 / 16]] * 6
    assert centers.mean(axis=0) == pytest.approx([0.5, 0.5])


def test_overlap_of_shifted_squares() -> None:
    many = votes((0, 0, 2, 2), (1, 0, 2, 2), (5, 0, 2, 2))
    assert intersection_over_union(many[0], many) == pytest.approx([1, 1 / 3, 0])


def test_overlapping_votes_are_averaged_by_score_and_others_kept() -> None:
    merged = merge_votes(votes((0, 0, 4, 4), (1, 0, 4, 4), (20, 0, 4, 4)), np.array([0.9, 0.3, 0.5]), overlap=0.3)
    assert [score for _, score in merged] == [0.9, 0.5]
    assert merged[0][0][0] == pytest.approx([0.25, 0])


def test_the_astronaut_is_found_with_the_eyes_in_place() -> None:
    (face,) = find_faces(astronaut(), detector=OpenCvFaceDetector())
    right, left = face.keypoints[:2]
    assert face.score > 0.8
    assert np.linalg.norm(right - [204, 102]) < 6
    assert np.linalg.norm(left - [247, 104]) < 6


def test_a_face_too_small_for_the_whole_picture_is_found_in_a_part() -> None:
    image = np.full((2048, 2048, 3), 90, np.uint8)
    image[1300:1812, 200:712] = astronaut()
    model = OpenCvLandmarkModel()
    (face,) = find_faces(
        image,
        detector=OpenCvFaceDetector(),
        confirmed=lambda box: locate_landmarks(image, box, model=model).score > 0.5,
    )
    assert np.linalg.norm(face.center - [200 + 225, 1300 + 125]) < 30
