"""Depth strokes become depths where they are drawn, and nothing elsewhere."""

import json

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.methods.portrait.depth_strokes import depth_strokes_map, read_depth_strokes


def test_strokes_are_scaled_to_the_picture(tmp_path):
    stroke = {"depth_m": 0.08, "width": 4, "points": [[0, 40], [80, 40]]}
    (tmp_path / "a.json").write_text(json.dumps({"strokes": [stroke]}))
    depth = read_depth_strokes(tmp_path / "a.json", shape=(40, 40), scale=(0.5, 0.5))
    assert np.isnan(depth[:16]).all()
    assert np.isnan(depth[24:]).all()
    assert (depth[20] == np.float32(0.08)).all()


def test_later_strokes_lie_over_earlier_ones():
    strokes = [{"depth_m": value, "width": 3, "points": [[0, 5], [10, 5]]} for value in (0.1, -0.2)]
    depth = depth_strokes_map(strokes, shape=(10, 10))
    assert np.unique(depth[np.isfinite(depth)]).tolist() == [np.float32(-0.2)]


@pytest.mark.parametrize(
    "content",
    [
        "",
        "[]",
        '{"strokes": 3}',
        '{"strokes": [3]}',
        '{"strokes": [{"points": [[0, 0], [1, 1]]}]}',
        '{"strokes": [{"depth_m": 0.1, "points": [1, 2]}]}',
        '{"strokes": [{"depth_m": 80, "points": [[0, 0], [1, 1]]}]}',
        '{"strokes": [{"depth_m": 0.1, "points": [[0, 0], [1, 1e99]]}]}',
        '{"strokes": [{"depth_m": NaN, "points": [[0, 0], [1, 1]]}]}',
    ],
)
def test_other_content_is_refused(tmp_path, content):
    (tmp_path / "a.json").write_text(content)
    with pytest.raises(InputError):
        read_depth_strokes(tmp_path / "a.json", shape=(8, 8))
