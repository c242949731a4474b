"""Laws of every edit: it is pure, it can be taken back to the bit, and what it makes is saved without loss."""

import inspect
import random

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from strip_hair import BALL, MOTION, SCALP, WIND, hairdo, rooted

from tress.base.errors import InputError
from tress.edit.registry import EDITS
from tress.edit.variation import Variation
from tress.io.formats.usd import open_document, save_document
from tress.model.diff import apply, reverse, squash
from tress.model.group import Group
from tress.model.keyframes import Keyframes
from tress.model.session import Session
from tress.model.strands import Strands
from tress.model.strip import Strip

LAX = settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
MOST_STRIPS = 25
CROSSING = rooted(SCALP[40])  # of the strip "b"
HAIR = Strands(points=np.eye(3), offsets=[0, 3], point_attributes={"color": np.full((3, 3), 0.5)})


def start():
    return hairdo(motion=MOTION, wind=WIND, hair=HAIR, c=CROSSING)


class Draw:
    """Arguments of edits that may fit a document."""

    def __init__(self, rng, document):
        self.rng, self.document = rng, document
        self.array = np.random.default_rng(rng.randrange(2**32))

    def of(self, *kinds):
        names = [name for name, record in self.document.records.items() if isinstance(record, kinds)]
        return self.rng.choice(names) if names else "absent"

    def strip(self):
        return self.of(Strip)

    def strips(self):
        return [self.of(Strip, Group) for _ in range(self.rng.randint(1, 2))]

    def new(self):
        return f"new_{self.rng.randrange(1000)}"

    def group(self):
        return self.rng.choice(["", self.of(Group)])

    def net(self, name):
        record = self.document.records.get(name)
        return record.weights.shape if isinstance(record, Strip) else (2, 2)

    def cells(self, name):
        rows, columns = self.net(name)
        return [[self.rng.randrange(rows), self.rng.randrange(columns)] for _ in range(self.rng.randint(1, 3))]

    def vector(self, size=0.02):
        return self.array.normal(0, size, 3)

    def variation(self):
        return Variation(
            location_m=0.02, turn_low=-1, curl_high=2, length_low=0.7, width_high=1.3, weight_low=0.7, knot_high=1.5
        )

    def flip(self):
        return self.rng.random() < 0.5


def displaced(draw):
    name = draw.strip()
    frame = draw.rng.choice(["world", "head", "root", "strip"])
    return {"points": {name: draw.cells(name)}, "by": draw.vector(), "frame": frame, "falloff_m": 0.03 * draw.flip()}


def weighed(draw):
    name = draw.strip()
    return {"names": [name], "weights": draw.array.uniform(0.5, 2, draw.net(name))}


def knotted(draw):
    name = draw.strip()
    rows, columns = draw.net(name)
    return {"names": [name], "knots_u": np.cumsum(draw.array.uniform(0.1, 1, rows + draw.rng.randint(2, 4)))}


def refined(draw):
    return {"names": [draw.strip()], "knots_u": draw.array.uniform(0.1, 0.9, 1)}


def keyed(draw):
    target, moments = draw.of(Strip, Group), draw.rng.randint(1, 3)
    position = isinstance(draw.document.records.get(target), Strip) and draw.flip()
    shape = draw.net(target) if position else (draw.rng.randint(1, 3), 1)
    return {
        "target": target,
        "name": draw.rng.choice(["", draw.of(Keyframes)]),
        "times": np.arange(moments) * 0.5,
        "values": draw.array.normal(0, 0.01, (moments, *shape, 3)),
        "kind": "position" if position else "displacement",
        "interpolation": draw.rng.choice(["linear", "cubic", "step"]),
    }


def laid(draw):
    return {"outer": [draw.strip()], "inner": [draw.strip()], "surface": "head", "max_iterations": 3}


def grown(draw):
    chosen = [int(draw.rng.choice(SCALP)) for _ in range(2)]
    into = draw.rng.choice(["cap", "tuft"])
    return {"names": [draw.strip()], "surface": "head", "triangles": chosen, "into": into, "flow": BALL.positions}


def combed(draw):
    way = draw.vector(1.0)
    return {"names": [draw.strip()], "surface": "head", "flow": lambda points: np.broadcast_to(way, points.shape)}


def turned(draw):
    move = np.eye(4)
    move[:3, 3] = draw.vector()
    return {"names": [draw.of(Strip, Strands)], "new_from_old": move}


PLANS = {
    "add": lambda draw: {"records": {draw.new(): Group(parent=draw.group())}},
    "attach": grown,
    "comb": combed,
    "cover": lambda draw: {"names": draw.strips(), "atlas": draw.rng.choice(["", "atlas"]), "regions": [0]},
    "delete": lambda draw: {"names": [draw.of(Strip, Group, Keyframes)]},
    "detach": lambda draw: {"names": draw.strips()},
    "displace": displaced,
    "duplicate": lambda draw: {"names": [draw.strip()], "variation": draw.variation(), "seed": draw.rng.randrange(99)},
    "group": lambda draw: {"names": draw.strips(), "into": draw.rng.choice([draw.new(), draw.of(Group)])},
    "hide": lambda draw: {"names": draw.strips(), "hidden": draw.flip()},
    "layer": laid,
    "lock": lambda draw: {"names": draw.strips(), "locked": draw.rng.random() < 0.2},
    "mirror": lambda draw: {"names": [draw.strip()], "normal": draw.vector(1.0), "into": draw.group()},
    "push_out": lambda draw: {"names": draw.strips(), "surface": "head", "max_iterations": 3},
    "recolour": lambda draw: {"name": "hair", "color": tuple(draw.array.random(3).tolist())},
    "refine": refined,
    "set_keyframes": keyed,
    "set_knots": knotted,
    "set_weights": weighed,
    "transform": turned,
    "ungroup": lambda draw: {"names": [draw.of(Group)]},
}


def step(rng, document):
    """A random edit of the document, or None where the arguments did not fit."""
    name = rng.choice(sorted(EDITS))
    crowded = len(document.of_type(Strip)) > MOST_STRIPS
    if crowded and name in ("duplicate", "attach", "mirror"):
        name = "delete"
    try:
        diff = EDITS[name](document, **PLANS[name](Draw(rng, document)))
        apply(diff, document)
    except InputError:
        return None
    return diff


def test_every_edit_has_a_plan_and_says_what_it_does():
    assert PLANS.keys() == EDITS.keys()
    assert all(inspect.getdoc(edit) for edit in EDITS.values())


@pytest.mark.parametrize("name", sorted(EDITS))
def test_every_edit_changes_something_the_same_each_time_and_can_be_taken_back(name):
    document, changed = start(), 0
    for seed in range(40):
        try:
            first, again = (EDITS[name](document, **PLANS[name](Draw(random.Random(seed), document))) for _ in range(2))
            after = apply(first, document)
        except InputError:
            continue
        assert first == again
        assert document == start()
        assert apply(reverse(first), after) == document
        changed += not first.is_empty
    assert changed > 3


@LAX
@given(st.integers(0, 2**32))
def test_undoing_a_hundred_random_edits_restores_the_document_to_the_bit(seed):
    rng, session = random.Random(seed), Session(start())
    whole, done = None, 0
    for _ in range(100):
        diff = step(rng, session.document)
        if diff is None or diff.is_empty:
            continue
        session.commit(diff)
        whole, done = diff if whole is None else squash(whole, diff), done + 1
    final = session.document
    assert done > 20
    for _ in range(done):
        session.undo()
    assert not session.can_undo
    assert session.document == start()
    assert apply(reverse(whole), final) == start()
    for _ in range(done):
        session.redo()
    assert session.document == final


@settings(LAX, max_examples=6)
@given(st.integers(0, 2**32))
def test_what_edits_make_is_saved_without_loss(tmp_path, seed):
    rng, document = random.Random(seed), start()
    for _ in range(15):
        diff = step(rng, document)
        document = document if diff is None else apply(diff, document)
    save_document(document, tmp_path / "hair.usdc")
    assert open_document(tmp_path / "hair.usdc") == document
