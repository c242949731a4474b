"""What lies on the scalp keeps still in a motion, what hangs swings."""

from dataclasses import replace

import numpy as np
import pytest
from strip_hair import BALL, RADIUS_M, SCALP

from tress.methods.strips.hanging_growth import ROWS, hanging_growth
from tress.methods.strips.motions import MotionParams, sway, wind
from tress.model.attachment import Attachment
from tress.model.document import Document
from tress.model.group import Group
from tress.model.head import Head
from tress.model.strip import Strip
from tress.model.strip_set import posed_points, strip_set
from tress.model.strip_shapes import flat_strip

PARAMS = MotionParams(amplitude_m=0.05, variety=1.0)


def strip(height_m: float, *, rooted: bool = True) -> Strip:
    """A strip that leads straight up from a triangle of the ball to `height_m` above it."""
    flat = flat_strip(length_m=height_m, width_m=0.01)
    along = np.linspace(0, height_m, len(flat.points))[:, None]
    points = np.stack(
        [flat.points[..., 1], 0 * flat.points[..., 1], np.broadcast_to(along, flat.weights.shape)], axis=-1
    )
    root = Attachment(surface="head", triangle=int(SCALP[3]), barycentric=[0.3, 0.3, 0.4], offset=[0, 0, 0])
    return replace(flat, points=points, root=root if rooted else None, group="tuft")


HAIR = Document(
    {
        "head": Head(mesh=BALL, shape=[], expression=[]),
        "tuft": Group(),
        "lies": strip(0.01),
        "leaves": strip(0.05),
        "hangs": strip(0.3),
    }
)


def test_growth_is_none_on_the_scalp_and_whole_at_the_tip_of_what_hangs():
    growth = hanging_growth(HAIR, ["lies", "leaves", "hangs"], stiffness=1.6)
    assert growth["lies"].tolist() == [0.0] * ROWS
    assert growth["hangs"][0] == 0 and growth["hangs"][-1] == 1 and (np.diff(growth["hangs"]) > 0).all()
    assert 0.02 < growth["leaves"][-1] < 0.5
    strips = strip_set(HAIR, ["hangs"])
    assert np.linalg.norm(strips.nets(posed_points(strips))[0][-1].mean(axis=0)) > RADIUS_M + 0.25


@pytest.mark.parametrize("motion", [sway, wind])
def test_motions_leave_alone_what_lies_on_the_scalp(motion):
    found = {item.target: item for item in motion(HAIR, targets=["tuft"], params=PARAMS).values()}
    assert set(found) == {"lies", "leaves", "hangs"}
    assert np.abs(found["lies"].values).max() == 0
    assert np.abs(found["hangs"].values).max() > 0.04


def test_strips_without_a_scalp_swing_as_their_group():
    free = Document({**HAIR.records, **{name: strip(0.1, rooted=False) for name in ("lies", "leaves", "hangs")}})
    (found,) = sway(free, targets=["tuft"], params=PARAMS).values()
    assert found.target == "tuft"
    assert hanging_growth(free, ["lies"], stiffness=1.0) == hanging_growth(free, [], stiffness=1.0) == {}


def test_neighbours_in_a_wind_swing_together():
    ways = np.random.default_rng(1).normal(0, 0.01, (40, 3))
    strips = {}
    for number, way in enumerate(ways):
        one = strip(0.3)
        strips[f"s{number}"] = replace(one, root=None, points=one.points + way)
    found = wind(Document({**HAIR.records, **strips}), targets=list(strips), params=replace(PARAMS, variety=0.25))
    tips = np.stack([item.values[:, -1, 0] for item in found.values()])
    assert np.linalg.norm(tips - tips.mean(axis=0), axis=2).max() < 0.35 * PARAMS.amplitude_m
