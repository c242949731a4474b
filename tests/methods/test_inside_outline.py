"""Hidden hair stays within the outline that the photograph shows."""

import numpy as np
import pytest

from tress.image.labels import BACKGROUND, FACE, HAIR
from tress.methods.portrait.box import Box
from tress.methods.portrait.inside_outline import FARTHEST, SOLID_ALPHA, before_hidden, inside_outline

SHAPE, SCALE, RADIUS_PX = (120, 120), 1000.0, 40
MATRIX = np.array([[SCALE, 0, 0, 60], [0, -SCALE, 0, 60], [0, 0, 0, 1]])
BOX = Box(np.array([-0.06, 0.06, -0.06]), 0.004, 30, 30, 30)


def disc() -> np.ndarray:
    """(H, W) bool: solid pixels around the middle, with a hole."""
    rows, columns = np.indices(SHAPE) + 0.5
    distance = np.hypot(rows - 60, columns - 60)
    return (distance < RADIUS_PX) & (distance > 8)


def moved(points: np.ndarray, *, head: float = 1.0) -> np.ndarray:
    """The points after the move, with a head that is `head` metres away from everything."""
    distance = np.full(BOX.shape, head, np.float32)
    return inside_outline(points, solid=disc(), xy_from_view=MATRIX, head_distance=distance, box=BOX)


@pytest.fixture
def around():
    """Points all around the disc, 3 mm outside of it."""
    angle = np.linspace(0, 2 * np.pi, 50)
    radius = RADIUS_PX / SCALE + 0.003
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.02 * angle - 0.05], axis=1).astype(np.float32)


def test_points_beside_the_outline_move_just_within_it_at_their_depth(around):
    found = moved(around)
    radius_px = np.hypot(found[:, 0], found[:, 1]) * SCALE
    assert (radius_px < RADIUS_PX).all() and (radius_px > RADIUS_PX - 4).all()
    assert np.array_equal(found[:, 2], around[:, 2])


def test_points_within_and_in_holes_stay():
    points = np.float32([[0, 0, 0], [0.02, 0.01, 0.01], [0, -0.03, -0.02]])
    assert np.array_equal(moved(points), points)


def test_points_far_out_and_those_that_would_get_into_the_head_stay(around):
    far = around * [1 + 2 * FARTHEST / 0.043, 1 + 2 * FARTHEST / 0.043, 1]
    assert np.array_equal(moved(far.astype(np.float32)), far.astype(np.float32))
    assert np.array_equal(moved(around, head=-0.001), around)


def test_without_solid_pixels_all_stay(around):
    nothing = np.zeros(SHAPE, bool)
    found = inside_outline(around, solid=nothing, xy_from_view=MATRIX, head_distance=np.ones(BOX.shape), box=BOX)
    assert np.array_equal(found, around)


def test_soft_hair_hides_beside_the_face_but_not_beside_the_background():
    label = np.full((1, 9), HAIR, np.uint8)
    label[0, 0], label[0, -1] = FACE, BACKGROUND
    alpha = np.full((1, 9), SOLID_ALPHA - 0.1, np.float32)
    assert before_hidden(alpha, label)[0].tolist() == [True] * 5 + [False] * 4
    assert before_hidden(np.ones_like(alpha), label).all()
