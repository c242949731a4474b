"""Hidden strands keep off the skin that a photograph shows, and go on behind the head."""

import numpy as np
from methods.small_head import SIZE, ball

from tress.image.labels import BACKGROUND, FACE, HAIR
from tress.kernel import fields
from tress.methods.portrait.off_bare_skin import bare_skin, off_bare_skin

SKIN = np.zeros((SIZE, SIZE), np.bool_)
SKIN[:, SIZE // 2 :] = True


def across(z: float, count: int = 20) -> fields.Traced:
    """Two level strands from side to side at depth `z`: a long one, and one wholly over the skin."""
    matrix = ball().xy_from_view
    column = np.concatenate([np.linspace(0.3, 0.6, count), np.linspace(0.55, 0.6, 5)]) * SIZE
    x = (column - matrix[0, 3]) / matrix[0, 0]
    y = np.full(len(x), (SIZE / 2 - matrix[1, 3]) / matrix[1, 1])
    return fields.Traced(
        points=np.stack([x, y, np.full(len(x), z)], axis=1),
        offsets=np.array([0, count, count + 5]),
        seed=np.array([7, 9]),
        rooted=np.array([True, True]),
        density=np.zeros((1, 1, 1), np.uint16),
    )


def test_what_lies_before_bare_skin_is_cut_off() -> None:
    strands = across(1.0)
    left = off_bare_skin(strands, skin=SKIN, head=ball())
    over = strands.points[:20, 0] * ball().xy_from_view[0, 0] + ball().xy_from_view[0, 3] >= SIZE // 2
    assert (left.points == strands.points[:20][~over]).all()
    assert left.offsets.tolist() == [0, int((~over).sum())]
    assert left.seed.tolist() == [7] and left.rooted.tolist() == [True]


def test_a_strand_that_loses_its_root_is_rooted_no_more() -> None:
    left = off_bare_skin(across(1.0), skin=~SKIN, head=ball())
    assert left.seed.tolist() == [7, 9] and left.rooted.tolist() == [False, True]


def test_of_a_strand_over_a_band_of_skin_the_longest_part_is_left() -> None:
    band = np.zeros_like(SKIN)
    band[:, int(0.35 * SIZE) : int(0.4 * SIZE)] = True
    strands = across(1.0)
    left = off_bare_skin(strands, skin=band, head=ball())
    assert (left.points[-6] == strands.points[19]).all()
    assert left.offsets[1] < 20 and not left.rooted[0]


def test_behind_the_head_and_without_skin_nothing_changes() -> None:
    for strands, skin in ((across(-1.0), SKIN), (across(1.0), np.zeros_like(SKIN))):
        left = off_bare_skin(strands, skin=skin, head=ball())
        assert (left.points == strands.points).all() and (left.offsets == strands.offsets).all()


def test_skin_is_bare_where_the_face_shows_through_little_hair() -> None:
    label = np.array([FACE, FACE, HAIR, BACKGROUND])
    assert bare_skin(np.array([0.2, 0.7, 0.2, 0.0]), label).tolist() == [True, False, False, False]
