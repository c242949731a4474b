"""Smooth skin on the crown is no hair; the same colour with locks, or another colour, is."""

import numpy as np
import pytest

from tress.head.landmarks import landmarks_of
from tress.image.labels import FACE, HAIR
from tress.methods.portrait.skin_likeness import skin_likeness

SKIN = np.array([205, 160, 140], np.float64)


@pytest.fixture(scope="module")
def face():
    """The average face, eyes 60 px apart, in the middle of a picture of 400 x 400 px."""
    from tress.head.hand_points import landmarks_from_named

    return landmarks_from_named({"right_eye": (170.0, 230.0), "left_eye": (230.0, 230.0)})


def picture(face, *, hair_color, locks: float, noise: float = 3.0) -> tuple[np.ndarray, np.ndarray]:
    """A skin-coloured picture whose upper part is hair of that colour, with locks of that contrast."""
    random = np.random.default_rng(1)
    top = face.points[:, 1].min() - 5
    row = np.arange(400)[:, None] + np.zeros((1, 400))
    label = np.where(row < top, HAIR, FACE).astype(np.uint8)
    colors = np.where((row < top)[..., None], np.asarray(hair_color, float), SKIN)
    waves = locks * np.sin(np.arange(400) * 2 * np.pi / 7) * (row < top)
    pixels = colors + waves[..., None] + random.normal(0, noise, (400, 400, 3))
    return np.clip(pixels, 0, 255).astype(np.uint8), label


@pytest.mark.parametrize(
    ("color", "locks", "bald"),
    [
        (SKIN, 0.0, True),
        (SKIN * 1.08, 0.0, True),
        (SKIN, 25.0, False),
        (SKIN * 0.4, 0.0, False),
        ((150, 150, 152), 0.0, False),
    ],
)
def test_skin_is_told_from_hair(face, color, locks, bald):
    pixels, label = picture(face, hair_color=color, locks=locks)
    assert skin_likeness(pixels, label=label, landmarks=face).is_skin == bald


def test_too_little_to_tell(face):
    label = np.full((400, 400), FACE, np.uint8)
    assert skin_likeness(np.zeros((400, 400, 3), np.uint8), label=label, landmarks=face) is None


def test_small_and_large_pictures_agree(face):
    pixels, label = picture(face, hair_color=SKIN, locks=0.0, noise=0.0)
    double = np.kron(pixels, np.ones((2, 2, 1), np.uint8)), np.kron(label, np.ones((2, 2), np.uint8))
    larger = landmarks_of(face.points * 2)
    found = skin_likeness(double[0], label=double[1], landmarks=larger)
    wanted = skin_likeness(pixels, label=label, landmarks=face)
    assert abs(found.lighter - wanted.lighter) < 1
    assert found.is_skin and wanted.is_skin
