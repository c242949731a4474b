"""Pictures of strands and confidence show what they are given."""

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.image.pictures import confidence_picture, traced_picture
from tress.image.trace import TracedStrands


def strand(y, *, occluded):
    points = np.stack([np.arange(2.5, 28), np.full(26, y)], axis=1).astype(np.float32)
    count = len(points)
    hidden = np.full(count, occluded)
    ones = np.ones(count, np.float32)
    return TracedStrands(points, np.array([0, count]), hidden, ones, np.ones((count, 3), np.float32), ones.copy())


def test_a_strand_is_drawn_along_its_row_over_the_darkened_photo():
    photo = np.full((20, 30, 3), 90, np.uint8)
    picture = traced_picture(photo, traced=strand(8.5, occluded=False))
    assert (picture[8, 4:26] >= 95).all()
    assert (picture[15] == 30).all()
    assert (photo == 90).all()


def test_occluded_vertices_are_red():
    picture = traced_picture(np.zeros((20, 30, 3), np.uint8), traced=strand(8.5, occluded=True)).astype(int)
    assert (picture[8, 5:25, 0] > 200).all()
    assert (picture[8, 5:25, 1] < 100).all()


def test_more_confidence_is_brighter():
    picture = confidence_picture(np.array([[0.0, 0.3, 0.7, 1.0, 5.0]])).astype(int).sum(axis=2)[0]
    assert (np.diff(picture[:4]) > 0).all()
    assert picture[3] == picture[4]


def test_other_pictures_are_refused():
    with pytest.raises(InputError, match="uint8"):
        traced_picture(np.zeros((20, 30)), traced=strand(8.5, occluded=False))
