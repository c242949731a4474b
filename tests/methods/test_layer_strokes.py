"""A few strokes mend what the automatic cut gets wrong in real photographs: hats, a scarf of the hair's colours."""

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from tress.base.report import Report
from tress.head.person import person_mask
from tress.head.read_face import read_face
from tress.image.strokes import NO_STROKE, read_strokes
from tress.methods.portrait.layers import layers_stage

STROKES = Path(__file__).with_name("layer_strokes")
HAIR_AT = {
    "019": [(330, 760), (640, 600)],
    "034": [(300, 500), (500, 250), (780, 700)],
    "037": [(480, 265)],
    "044": [(250, 720), (660, 700)],
    "046": [],
}
FREE_AT = {
    "019": [(450, 150), (160, 290), (300, 100)],
    "034": [(600, 560), (250, 850), (100, 300)],
    "037": [(520, 140), (240, 500), (730, 600), (500, 770)],
    "044": [(500, 160), (600, 240), (480, 450)],
    "046": [(600, 120), (690, 300), (500, 720), (300, 850)],
}
"""Middles (x, y) px of squares of 21 px, none of them on a stroke, that surely are hair or surely are not."""


@pytest.mark.parametrize("name", sorted(HAIR_AT))
def test_a_few_strokes_mend_a_real_photograph(name: str, open_data: Callable[[str], Path]) -> None:
    picture = cv2.imread(str(open_data(f"portraits/{name}.jpg")), cv2.IMREAD_COLOR)
    assert picture is not None
    image = np.ascontiguousarray(picture[..., ::-1])
    landmarks = read_face(image)
    person = person_mask(image, landmarks=landmarks)
    strokes = read_strokes(STROKES / f"{name}.json", shape=image.shape[:2])
    before, after = (
        layers_stage(image, landmarks=landmarks, person=person, strokes=drawn, report=Report()).hair_mask
        for drawn in (None, strokes)
    )
    drawn_share = (strokes != NO_STROKE).mean()
    wrong = [_errors(mask, name) for mask in (before, after)]
    assert wrong[0] > 0 and wrong[1] == 0, wrong
    assert (before != after).mean() > 3 * drawn_share, "strokes carry to what looks like them"


def _errors(hair: np.ndarray, name: str) -> int:
    """How many of the squares came out wrong for the most part."""
    missed = sum(_share(hair, x, y) < 0.6 for x, y in HAIR_AT[name])
    return missed + sum(_share(hair, x, y) > 0.4 for x, y in FREE_AT[name])


def _share(hair: np.ndarray, x: int, y: int) -> float:
    return float(hair[y - 10 : y + 11, x - 10 : x + 11].mean())
