"""Strokes from masks and polylines."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from tress.base.errors import InputError
from tress.image.labels import BODY, FACE, HAIR
from tress.image.strokes import NO_STROKE, read_strokes, strokes_from_mask, strokes_from_polylines

SHAPE = (40, 60)


def test_a_polyline_covers_its_width_and_nothing_else() -> None:
    drawn = strokes_from_polylines([{"layer": "hair", "width": 6, "points": [[10, 20], [50, 20]]}], shape=SHAPE)
    rows, columns = np.nonzero(drawn == HAIR)
    assert rows.min() >= 16 and rows.max() <= 23 and columns.min() >= 6 and columns.max() <= 53
    assert (drawn[18:22, 12:48] == HAIR).all()
    assert set(np.unique(drawn)) == {HAIR, NO_STROKE}


def test_later_strokes_lie_over_earlier_ones_and_a_point_is_a_dot() -> None:
    strokes = [
        {"layer": "hair", "width": 10, "points": [[30, 20]]},
        {"layer": "face", "width": 4, "points": [[30, 20]]},
    ]
    drawn = strokes_from_polylines(strokes, shape=SHAPE)
    assert drawn[20, 30] == FACE and drawn[20, 26] == HAIR and drawn[0, 0] == NO_STROKE


@pytest.mark.parametrize("grey", [True, False])
def test_a_mask_says_the_same_grey_or_coloured(tmp_path: Path, grey: bool) -> None:
    labels = np.full(SHAPE, NO_STROKE, np.uint8)
    labels[5:9, 10:20] = HAIR
    labels[30:33, 40:50] = BODY
    picture = labels
    if not grey:
        picture = np.zeros((*SHAPE, 4), np.uint8)
        picture[labels == HAIR] = (0, 0, 255, 255)
        picture[labels == BODY] = (0, 255, 0, 255)
        picture[0, 0] = (0, 255, 0, 20)
    path = tmp_path / "strokes.png"
    cv2.imwrite(str(path), picture)
    assert np.array_equal(read_strokes(path, shape=SHAPE), labels)


def test_json_is_read(tmp_path: Path) -> None:
    strokes = [{"layer": "hair", "width": 12, "points": [[5, 5], [20, 30]]}]
    path = tmp_path / "strokes.json"
    path.write_text(json.dumps({"strokes": strokes}))
    assert np.array_equal(read_strokes(path, shape=SHAPE), strokes_from_polylines(strokes, shape=SHAPE))


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("not json", "not JSON"),
        ("[1, 2]", "no list"),
        ('{"strokes": [3]}', "an object"),
        ('{"strokes": [{"layer": "beard", "points": [[1, 1]]}]}', "beard"),
        ('{"strokes": [{"layer": "hair", "points": []}]}', "no points"),
        ('{"strokes": [{"layer": "hair", "points": [[1, 2, 3]]}]}', "no points"),
        ('{"strokes": [{"layer": "hair", "points": [["a", "b"]]}]}', "no points"),
        ('{"strokes": [{"layer": "hair", "points": [[NaN, 1]]}]}', "no points"),
        ('{"strokes": [{"layer": "hair", "width": -1, "points": [[1, 2]]}]}', "width"),
    ],
)
def test_bad_json_is_refused_with_its_reason(tmp_path: Path, content: str, reason: str) -> None:
    path = tmp_path / "strokes.json"
    path.write_text(content)
    with pytest.raises(InputError, match=reason):
        read_strokes(path, shape=SHAPE)


def test_a_mask_of_another_size_or_no_picture_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="60 x 40"):
        strokes_from_mask(np.zeros((41, 60), np.uint8), shape=SHAPE)
    path = tmp_path / "strokes.png"
    path.write_bytes(b"")
    with pytest.raises(InputError, match="neither"):
        read_strokes(path, shape=SHAPE)
    with pytest.raises(InputError, match="does not exist"):
        read_strokes(tmp_path / "none.png", shape=SHAPE)


@pytest.mark.parametrize("points", [[[-50, 10], [-20, 30]], [[10, 200], [30, 150]], [[90, 40]]])
def test_a_stroke_beside_the_photograph_is_refused(points: list[list[int]]) -> None:
    with pytest.raises(InputError, match="stroke 0 lies beside the photograph of 60 x 80 px"):
        strokes_from_polylines([{"layer": "hair", "width": 20, "points": points}], shape=(80, 60))


def test_a_stroke_that_reaches_into_the_photograph_is_taken() -> None:
    drawn = strokes_from_polylines([{"layer": "hair", "width": 20, "points": [[-5, 40]]}], shape=(80, 60))
    assert drawn[40, 0] == HAIR
