"""The pictures of the stages show what they are given."""

from itertools import pairwise

import numpy as np

from tress.methods.portrait.pictures import (
    depth_colors,
    layers_picture,
    matte_picture,
    mesh_picture,
    orientation_picture,
    strands_picture,
    thinned,
)


def test_a_horizontal_strand_fills_its_row_and_nearer_ones_lie_over_it():
    points = np.array([[2.5, 4.5], [9.5, 4.5], [5.5, 0.5], [5.5, 9.5]])
    colors = np.array([[255, 0, 0], [255, 0, 0], [0, 0, 255], [0, 0, 255]], np.uint8)
    offsets, shape = np.array([0, 2, 4]), (10, 12)
    picture = strands_picture(points, offsets=offsets, colors=colors, shape=shape, depth=np.array([1.0, 1, 0, 0]))
    assert (picture[4, 2:9] == [255, 0, 0]).all()
    assert (picture[[1, 8], 5] == [0, 0, 255]).all()
    assert not picture[:, 10:].any()
    turned = strands_picture(points, offsets=offsets, colors=colors, shape=shape, depth=np.array([0.0, 0, 1, 1]))
    assert (turned[4, 5] == [0, 0, 255]).all()


def test_of_many_strands_some_are_drawn():
    lengths = np.random.default_rng(0).integers(2, 9, 41)
    offsets = np.concatenate([[0], np.cumsum(lengths)])
    every, own = thinned(offsets, most_strands=100)
    assert np.array_equal(every, np.arange(offsets[-1])) and np.array_equal(own, offsets)
    fewer, own = thinned(offsets, most_strands=10)
    assert len(own) - 1 <= 10
    for strand, (begin, end) in zip(range(0, 41, 5), pairwise(own), strict=True):
        assert np.array_equal(fewer[begin:end], np.arange(offsets[strand], offsets[strand + 1]))


def test_strands_outside_the_picture_are_cut_off():
    points = np.array([[-50.0, 3.0], [50.0, 3.0]])
    picture = strands_picture(points, offsets=np.array([0, 2]), colors=np.full((2, 3), 9, np.uint8), shape=(6, 6))
    assert (picture[3] == 9).all()
    assert picture.sum() == 6 * 3 * 9


def test_orientation_shows_nothing_where_none_is_given():
    angle = np.array([[np.nan, 0.0, np.pi / 2]])
    picture = orientation_picture(angle, confidence=np.ones((1, 3)))
    assert not picture[0, 0].any()
    assert picture[0, 1].argmax() == 0  # horizontal is red
    assert (picture[0, 1] != picture[0, 2]).any()


def test_full_alpha_shows_the_colour_and_no_alpha_grey():
    foreground = np.full((1, 2, 3), 1.0, np.float32)
    picture = matte_picture(np.array([[1.0, 0.0]], np.float32), foreground=foreground)
    assert picture.shape == (1, 4, 3)
    assert picture[0, :, 0].tolist() == [255, 0, 255, 118]


def test_layers_are_tinted_and_bordered():
    pixels = np.full((8, 8, 3), 100, np.uint8)
    label = np.zeros((8, 8), np.uint8)
    label[:, 4:] = 3
    picture = layers_picture(pixels, label=label)
    assert picture[0, 0].argmax() == 2
    assert picture[0, 7].argmax() == 0
    assert (picture[:, 3:5] == 255).all()


def test_only_triangles_that_face_the_camera_are_drawn():
    pixels = np.zeros((20, 20, 3), np.uint8)
    xy = np.array([[2.5, 17.5], [17.5, 17.5], [9.5, 2.5]])  # counter-clockwise as seen, y down
    none = np.zeros((0, 2))
    assert mesh_picture(pixels, xy_px=xy, triangles=np.array([[0, 1, 2]]), landmarks_px=none).any()
    assert not mesh_picture(pixels, xy_px=xy, triangles=np.array([[0, 2, 1]]), landmarks_px=none).any()


def test_nearer_is_brighter():
    near, far = depth_colors(np.array([0.0, 1.0]))[::-1].astype(int)
    assert near.sum() > far.sum()
