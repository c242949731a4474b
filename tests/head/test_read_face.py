"""From a picture to one face: laws, choices and errors."""

import json
from pathlib import Path

import numpy as np
import pytest

from tests.head.faces import astronaut
from tress.base.errors import AssetMissingError, FormatError, InputError, NoFaceError
from tress.base.report import Report
from tress.head.assets import asset
from tress.head.detector import OpenCvFaceDetector
from tress.head.face_mesh import OpenCvLandmarkModel
from tress.head.hand_points import landmarks_from_named, read_hand_points
from tress.head.landmarks import FaceLandmarks, landmarks_of
from tress.head.person import OpenCvPersonSegmenter, person_mask
from tress.head.read_face import read_face
from tress.head.statistical import load_statistical_head


def warnings_of(report: Report) -> str:
    return " ".join(warning for stage in report.stages for warning in stage.warnings)


def test_a_mirrored_photograph_has_mirrored_landmarks() -> None:
    image = astronaut()
    found = read_face(image)
    mirrored = read_face(np.ascontiguousarray(image[:, ::-1]))
    back = mirrored.points[load_statistical_head().landmark_mirror] * [-1, 1, 1] + [image.shape[1], 0, 0]
    distance = np.linalg.norm((back - found.points)[:, :2], axis=1)
    assert distance.mean() < 0.04 * found.inter_ocular_px


def test_an_enlarged_photograph_has_enlarged_landmarks() -> None:
    image = astronaut()
    found, larger = read_face(image), read_face(np.repeat(np.repeat(image, 2, axis=0), 2, axis=1))
    assert np.linalg.norm((larger.points / 2 - found.points)[:, :2], axis=1).mean() < 0.03 * found.inter_ocular_px


def test_a_picture_without_a_face_is_refused() -> None:
    with pytest.raises(NoFaceError, match="No face was found"):
        read_face(np.full((300, 300, 3), 128, np.uint8))


@pytest.mark.parametrize("seed", range(4))
def test_noise_holds_no_face(seed: int) -> None:
    noise = np.random.default_rng(seed).integers(0, 255, (256, 256, 3)).astype(np.uint8)
    with pytest.raises(NoFaceError, match="No face was found"):
        read_face(noise)


def test_of_two_faces_the_larger_is_taken_and_the_other_can_be_named() -> None:
    small = astronaut()[::2, ::2]
    image = np.zeros((512, 768, 3), np.uint8)
    image[:, :512] = astronaut()
    image[100:356, 512:] = small
    first, second = read_face(image), read_face(image, face=1)
    assert first.box[2] < 512 < second.box[0]
    with pytest.raises(InputError, match="Face 9"):
        read_face(image, face=9)


def test_of_two_plain_faces_one_is_taken_with_a_warning() -> None:
    report = Report()
    pair = np.concatenate([astronaut(), astronaut()[:, ::-1]], axis=1)
    read_face(pair, report=report)
    assert "2 faces" in warnings_of(report)


def test_a_cut_off_face_is_refused_and_a_tiny_one_too() -> None:
    found = read_face(astronaut())
    cut = landmarks_of(found.points - [found.points[:, 0].mean(), 0, 0])
    with pytest.raises(NoFaceError, match="cut off"):
        read_face(astronaut(), landmarks=cut)
    with pytest.raises(NoFaceError, match="too small"):
        read_face(astronaut(), landmarks=landmarks_of(found.points * 0.2))


def test_all_landmarks_from_a_file_are_used_as_they_are(tmp_path: Path) -> None:
    found = read_face(astronaut())
    path = tmp_path / "points.json"
    path.write_text(json.dumps({"points": found.points.tolist()}))
    given = read_hand_points(path)
    assert isinstance(given, FaceLandmarks)
    assert np.array_equal(read_face(astronaut(), landmarks=given).points, found.points)


def test_two_eyes_show_the_network_where_to_look() -> None:
    found = read_face(astronaut())
    (rx, ry), (lx, ly) = found.eyes.tolist()
    read = read_face(astronaut(), landmarks={"right_eye": (rx + 3, ry), "left_eye": (lx, ly - 2)})
    assert np.linalg.norm((read.points - found.points)[:, :2], axis=1).mean() < 0.06 * found.inter_ocular_px


def test_where_the_network_sees_nothing_an_average_face_is_laid_on_the_points() -> None:
    report = Report()
    points = {"right_eye": (220.0, 260.0), "left_eye": (300.0, 260.0)}
    read = read_face(np.full((512, 512, 3), 128, np.uint8), landmarks=points, report=report)
    assert read.eyes == pytest.approx(np.array([[220, 260], [300, 260]]), abs=0.5)
    assert "average face" in warnings_of(report)
    assert read.points[152, 1] > 330


def test_more_points_turn_the_average_face() -> None:
    straight = landmarks_from_named({"right_eye": (220, 260), "left_eye": (300, 260)})
    names = {"nose": 1, "chin": 152, "mouth_left": 291, "mouth_right": 61}
    points = {name: tuple(straight.points[index, :2].tolist()) for name, index in names.items()}
    points |= {"right_eye": (220.0, 260.0), "left_eye": (300.0, 260.0)}
    again = landmarks_from_named(points)
    assert np.abs(again.points - straight.points).max() < 1
    x, y = points["nose"]
    turned = landmarks_from_named(points | {"nose": (x + 12, y)})
    depth = turned.points[:, 2]
    assert depth[234] - depth[454] > 20


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("not json", "cannot be read"),
        ('{"nose": [1, 2]}', "left_eye and right_eye"),
        ('{"nostril": [1, 2]}', "nostril"),
        ('{"nose": [1]}', "two numbers"),
        ("[[1, 2], [3, 4]]", "468"),
        ('{"left_eye": [1, 2], "right_eye": [1, 2]}', "same place"),
    ],
)
def test_a_wrong_file_of_landmarks_is_refused(tmp_path: Path, content: str, words: str) -> None:
    path = tmp_path / "points.json"
    path.write_text(content)
    with pytest.raises(InputError, match=words):
        points = read_hand_points(path)
        assert isinstance(points, dict)
        landmarks_from_named(points)


def test_a_missing_asset_says_how_to_build_it() -> None:
    with pytest.raises(AssetMissingError, match="make assets"):
        asset("no_such_network.tflite")


def test_a_named_model_file_that_is_absent_or_no_network_is_refused(tmp_path: Path) -> None:
    with pytest.raises(AssetMissingError, match=r"mine\.tflite"):
        OpenCvFaceDetector(tmp_path / "mine.tflite")
    (tmp_path / "text.tflite").write_text("hello")
    with pytest.raises(FormatError, match=r"text\.tflite"):
        OpenCvLandmarkModel(tmp_path / "text.tflite")


def test_the_person_mask_holds_the_face_and_not_the_flag() -> None:
    image = astronaut()
    found = read_face(image)
    for mask in (person_mask(image), person_mask(image, landmarks=found)):
        assert mask.shape == image.shape[:2]
        assert mask[120, 225] > 0.9
        assert mask[60, 40] < 0.2


def test_a_small_person_is_looked_at_from_close_by() -> None:
    image = np.full((1536, 1536, 3), 60, np.uint8)
    image[500:1012, 500:1012] = astronaut()
    found = read_face(image)
    whole, near = person_mask(image), person_mask(image, landmarks=found)
    alone = OpenCvPersonSegmenter().probability(astronaut())
    box = np.s_[540:700, 650:800]
    truth = alone[40:200, 150:300]
    assert np.abs(near[box] - truth).mean() < np.abs(whole[box] - truth).mean()
