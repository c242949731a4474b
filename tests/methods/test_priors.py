"""The location prior and the stages of layers and matte on a drawn head."""

import cv2
import numpy as np
import pytest

from tress.base.report import Report
from tress.head.landmarks import CHIN, FACE_OVAL, FOREHEAD, LEFT_EYE_CORNERS, RIGHT_EYE_CORNERS, landmarks_of
from tress.image.labels import BACKGROUND, BODY, FACE, HAIR
from tress.methods.portrait.layers import has_hair, layers_stage
from tress.methods.portrait.matte import matte_stage
from tress.methods.portrait.priors import face_frame, location_prior

BROWS = {70: -0.3, 63: -0.25, 105: -0.2, 66: -0.12, 107: -0.06, 336: 0.06, 296: 0.12, 334: 0.2, 293: 0.25, 300: 0.3}


def drawn_landmarks(*, center: tuple[float, float], height: float, roll: float = 0.0):
    """468 points of a face `height` px from chin to forehead, upright and frontal but for `roll` (radians)."""
    points = np.zeros((468, 3))
    turn = 2 * np.pi * np.arange(36) / 36
    points[list(FACE_OVAL), :2] = np.column_stack([0.4 * np.sin(turn), -0.5 * np.cos(turn)])
    points[FOREHEAD], points[CHIN] = (0, -0.5, 0), (0, 0.5, 0)
    for corners, side in ((RIGHT_EYE_CORNERS, -1), (LEFT_EYE_CORNERS, 1)):
        points[list(corners), :2] = [(side * 0.3, -0.1), (side * 0.1, -0.1)]
    for brow, x in BROWS.items():
        points[brow, :2] = (x, -0.2)
    cos, sin = np.cos(roll), np.sin(roll)
    points[:, :2] = points[:, :2] @ np.array([[cos, sin], [-sin, cos]])
    return landmarks_of(points * height + [*center, 0])


def drawn_photo(*, hair: tuple[int, int, int], side: int = 300, at: tuple[int, int] = (150, 130), height: int = 100):
    """Photograph and person mask: a head with a cap of hair 0.25 heights thick, a shirt, before a plain backdrop."""
    scale = height / 100
    image = np.full((side, side, 3), (150, 190, 210), np.uint8)
    person = np.zeros((side, side), np.uint8)

    def ellipse(color: tuple[int, int, int], radii: tuple[int, int], shift: int = 0) -> None:
        place = (at[0], at[1] + round(shift * scale))
        size = (round(radii[0] * scale), round(radii[1] * scale))
        cv2.ellipse(image, place, size, 0, 0, 360, color, -1)
        cv2.ellipse(person, place, size, 0, 0, 360, 1, -1)

    ellipse((40, 120, 60), (95, 90), shift=140)
    ellipse((215, 165, 140), (20, 40), shift=40)
    ellipse(hair, (58, 75), shift=-18)
    ellipse((215, 165, 140), (41, 58), shift=-2)
    noise = np.random.default_rng(0).normal(0, 5, image.shape)
    return np.clip(image + noise, 0, 255).astype(np.uint8), person.astype(np.float32)


def test_the_frame_turns_with_the_face() -> None:
    upright = face_frame(drawn_landmarks(center=(100, 100), height=80))
    rolled = face_frame(drawn_landmarks(center=(100, 100), height=80, roll=0.5))
    assert upright.height_px == pytest.approx(80) and rolled.height_px == pytest.approx(80)
    assert upright.axes == pytest.approx(np.diag([1, -1, 1]), abs=1e-6)
    assert upright.axes[1, :2] @ rolled.axes[1, :2] == pytest.approx(np.cos(0.5))
    assert rolled.axes @ rolled.axes.T == pytest.approx(np.eye(3), abs=1e-9)
    assert upright.cranium[1] < upright.eyes[1], "the cranium's middle is above the eyes"


def test_the_prior_knows_where_layers_lie() -> None:
    person = np.ones((300, 300), np.float32)
    person[:, :20] = 0
    prior = location_prior(drawn_landmarks(center=(150, 130), height=100), person=person)
    assert prior.sum(axis=-1) == pytest.approx(1, abs=1e-5) and (prior > 0).all()
    places = {HAIR: (45, 150), FACE: (140, 150), BODY: (285, 150), BACKGROUND: (150, 5)}
    for layer, (row, column) in places.items():
        assert prior[row, column].argmax() == layer
    assert prior[150, 130, HAIR] < 0.02, "beard, eyes and lips are no hair"


def test_the_prior_of_a_mirrored_face_is_mirrored() -> None:
    prior = location_prior(drawn_landmarks(center=(150, 130), height=100), person=np.ones((300, 300), np.float32))
    assert np.abs(prior - prior[:, ::-1]).mean() < 0.01


def test_the_stages_lift_the_hair_of_a_drawn_head() -> None:
    image, person = drawn_photo(hair=(60, 35, 20))
    landmarks, report = drawn_landmarks(center=(150, 130), height=100), Report()
    layers = layers_stage(image, landmarks=landmarks, person=person, report=report)
    matte = matte_stage(image, layers=layers, landmarks=landmarks, report=report)
    truth = np.linalg.norm(image.astype(float) - (60, 35, 20), axis=-1) < 40
    assert (layers.hair_mask & truth).sum() / (layers.hair_mask | truth).sum() > 0.85
    assert has_hair(layers, landmarks=landmarks)
    assert np.abs(matte.alpha - truth).mean() < 0.03
    sure = matte.alpha > 0.9
    assert np.abs(matte.foreground[sure].mean(axis=0) - [0.045, 0.017, 0.007]).max() < 0.01


def test_a_bald_head_has_no_hair() -> None:
    image, person = drawn_photo(hair=(215, 165, 140))
    landmarks, report = drawn_landmarks(center=(150, 130), height=100), Report()
    layers = layers_stage(image, landmarks=landmarks, person=person, report=report)
    assert not has_hair(layers, landmarks=landmarks)


def test_a_small_head_in_a_large_picture_gets_patches_of_its_own() -> None:
    image, person = drawn_photo(hair=(60, 35, 20), side=1200, at=(900, 300), height=100)
    landmarks = drawn_landmarks(center=(900, 300), height=100)
    layers = layers_stage(image, landmarks=landmarks, person=person, report=Report())
    truth = np.linalg.norm(image.astype(float) - (60, 35, 20), axis=-1) < 40
    assert layers.label.shape == image.shape[:2] and (layers.label[1000:, :300] == BACKGROUND).all()
    assert (layers.hair_mask & truth).sum() / (layers.hair_mask | truth).sum() > 0.85
    head = layers.superpixels[200:400, 800:1000]
    assert len(np.unique(head)) > 200


def test_eyes_and_nose_are_no_hair_though_they_look_like_it() -> None:
    """A dark eye that touches the hair through a dark smear at the temple stays face."""
    image, person = drawn_photo(hair=(40, 25, 20))
    landmarks = drawn_landmarks(center=(150, 130), height=100)
    cv2.ellipse(image, (130, 120), (10, 5), 0, 0, 360, (40, 25, 20), -1)
    cv2.line(image, (130, 120), (95, 112), (40, 25, 20), 6)
    layers = layers_stage(image, landmarks=landmarks, person=person, report=Report())
    assert layers.hair_mask[55, 150] and not layers.hair_mask[115:126, 122:139].any()
