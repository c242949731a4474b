"""Simulated strips: what follows, what hangs, what stays outside, what comes to rest, and what undoes."""

from dataclasses import replace

import numpy as np
import pytest
from strip_hair import BALL, BASE, RADIUS_M, SCALP, rooted

from tress.base.errors import CancelledError, InputError, ParameterError
from tress.base.report import Report
from tress.dynamics.head_motion import HEAD_MOTIONS, head_motion_of, keyed, moved, moved_back, turn
from tress.dynamics.params import HairParams
from tress.dynamics.simulate import simulate
from tress.dynamics.surface_field import surface_field
from tress.edit.lock import lock
from tress.edit.selection import LockedError
from tress.kernel.dynamics import DynamicsParams
from tress.kernel.geom import signed_distances
from tress.model.diff import apply, reverse
from tress.model.document import Document
from tress.model.evaluate import evaluate
from tress.model.keyframes import Keyframes
from tress.model.strip import Strip
from tress.model.strip_set import posed_points, strip_set

SHORT = HairParams(duration_secs=0.5, settle_secs=0)
STRAIGHT = Document(
    {
        "head": BASE["head"],
        "tuft": BASE["tuft"],
        **{f"s{index}": rooted(triangle, group="tuft") for index, triangle in enumerate(SCALP[::25])},
    }
)


def shown(document: Document, secs: float) -> np.ndarray:
    return posed_points(strip_set(document, sorted(document.of_type(Strip))), secs)


def simulated(document: Document = STRAIGHT, **settings) -> Document:
    return apply(simulate(document, targets=["tuft"], **{"hair": SHORT, **settings}), document)


def test_strips_of_goal_weight_one_follow_exactly() -> None:
    stiff = replace(SHORT, root_goal=1.0, tip_goal=1.0)
    moving = simulated(hair=stiff, head_motion=turn, surface="head")
    for secs in (0.0, 0.25, 0.5):
        assert shown(moving, secs) == pytest.approx(shown(STRAIGHT, 0), abs=1e-12)


def test_free_strips_hang_down_from_their_roots() -> None:
    free = HairParams(duration_secs=0.1, settle_secs=8, root_goal=0, tip_goal=0)
    moving = simulated(hair=free, forces=DynamicsParams(bend=0, drag=8, roots="hinged"))
    strips = strip_set(moving, ["s0"])
    net = strips.nets(posed_points(strips, 0.1))[0].mean(axis=1)
    along = np.diff(net, axis=0)
    down = -along[:, 1] / np.linalg.norm(along, axis=1)
    assert down.min() > 0.999


def test_lengths_are_kept() -> None:
    moving = simulated(head_motion=turn, forces=DynamicsParams(stretch=1e9, substeps=12))
    strips = strip_set(moving, sorted(moving.of_type(Strip)))

    def lengths(secs: float) -> np.ndarray:
        nets = strips.nets(posed_points(strips, secs))
        return np.array([np.linalg.norm(np.diff(net.mean(axis=1), axis=0), axis=1).sum() for net in nets])

    assert lengths(0.4) == pytest.approx(lengths(0.0), rel=0.01)


def test_hair_stays_outside_the_head_in_every_frame() -> None:
    moving = simulated(hair=HairParams(duration_secs=1.5, root_goal=0.1, tip_goal=0), head_motion=turn, surface="head")
    start = signed_distances(BALL.positions, triangles=BALL.triangles, queries=shown(STRAIGHT, 0)).distance
    for secs in np.arange(0, 1.5, 0.1):
        found = signed_distances(BALL.positions, triangles=BALL.triangles, queries=shown(moving, secs)).distance
        assert (found > np.minimum(start, 0.01) - 0.0015).all()


def test_hair_comes_to_rest_after_a_turn() -> None:
    report = Report()
    hair = HairParams(duration_secs=6)
    diff = simulate(STRAIGHT, targets=["tuft"], hair=hair, head_motion=turn, report=report)
    moving = apply(diff, STRAIGHT)
    numbers = {stage.name: stage.numbers for stage in report.stages}["simulate"]
    assert numbers["last_speed"] < 0.01
    speed = np.linalg.norm(shown(moving, 0.5) - shown(moving, 0.4), axis=1).max() / 0.1
    assert speed > 0.05


def test_wind_blows_hair_downwind() -> None:
    moving = simulated(hair=HairParams(duration_secs=1), forces=DynamicsParams(wind_speed=6, wind_yaw=0, gusts=0))
    assert (shown(moving, 1.0) - shown(simulated(), 0.5))[:, 2].mean() < -0.005


def test_the_same_input_gives_the_same_bits() -> None:
    first, second = (simulated(head_motion=turn, surface="head") for _ in range(2))
    assert (shown(first, 0.5) == shown(second, 0.5)).all()


def test_baking_replaces_what_moved_the_strips_and_undoes() -> None:
    swing = Keyframes(target="tuft", times=[0, 1], values=np.zeros((2, 2, 1, 3)), frame="head")
    before = Document({**STRAIGHT.records, "swing": swing})
    diff = simulate(before, targets=["tuft"], hair=SHORT)
    after = apply(diff, before)
    assert "swing" not in after.records and len(after.of_type(Keyframes)) == len(SCALP[::25])
    assert apply(reverse(diff), after) == before
    assert evaluate(after, 0.3).meshes
    with pytest.raises(InputError, match="simulate all of 'tuft'"):
        simulate(before, targets=["s0"], hair=SHORT)


def test_links_hold_neighbours_together() -> None:
    beside = {f"s{index}": rooted(SCALP[40 + index], group="tuft") for index in range(2)}
    pair = Document({**{name: STRAIGHT.records[name] for name in ("head", "tuft")}, **beside})
    loose = HairParams(duration_secs=1, settle_secs=0, root_goal=0, tip_goal=0)
    forces = DynamicsParams(wind_speed=5, gusts=2, gust_secs=0.3, across=1e6, iterations=8, bend=0)

    def change(hair: HairParams) -> float:
        moving = simulated(pair, hair=hair, forces=forces)
        middles = [
            [net.mean(axis=1) for net in strip_set(moving, ["s0", "s1"]).nets(shown(moving, secs))] for secs in (0, 1)
        ]
        apart = [np.linalg.norm(first - second, axis=1) for first, second in middles]
        return float(np.abs(apart[0] - apart[1]).max())

    assert change(replace(loose, link_distance=0.1)) < 0.005 < change(loose)


def test_a_locked_strip_and_nothing_to_move_are_refused() -> None:
    locked = apply(lock(STRAIGHT, names=["s0"]), STRAIGHT)
    with pytest.raises(LockedError):
        simulate(locked, targets=["tuft"])
    with pytest.raises(InputError, match="No strip"):
        simulate(STRAIGHT, targets=[])
    with pytest.raises(InputError):
        simulate(STRAIGHT, targets=["tuft"], surface="hat")


@pytest.mark.parametrize("wrong", [{"duration_secs": 0.0}, {"density": 0.0}, {"root_goal": 1.5}, {"frames_per_sec": 0}])
def test_numbers_outside_their_ranges_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match=next(iter(wrong))):
        HairParams(**wrong)


def test_it_can_be_cancelled() -> None:
    with pytest.raises(CancelledError):
        simulate(STRAIGHT, targets=["tuft"], report=Report(cancelled=lambda: True))


@pytest.mark.parametrize("name", HEAD_MOTIONS)
def test_head_motions_are_smooth_and_rigid(name: str) -> None:
    motion = head_motion_of(name)
    points = np.random.default_rng(0).normal(size=(20, 3))
    for secs in (0.0, 0.4, 1.4):
        pose = motion(secs)
        assert moved_back(moved(points, pose=pose), pose=pose) == pytest.approx(points)
        assert np.linalg.norm(motion(secs + 1e-4) - pose) < 2e-3


def test_a_motion_by_poses_reads_as_it_is_keyed() -> None:
    half = np.sqrt(0.5)
    motion = keyed([0, 2], [[0, 0, 0, 1, 0, 0, 0], [0, half, 0, half, 0, 0, 1]])
    assert moved(np.array([[0.0, 0, 1]]), pose=motion(1.0)) == pytest.approx(np.array([[half, 0, half + 0.5]]))
    assert motion(9.0) == pytest.approx(motion(2.0))
    with pytest.raises(InputError, match="do not rise"):
        keyed([1, 1], [[0, 0, 0, 1, 0, 0, 0]] * 2)
    with pytest.raises(InputError, match="no rotation"):
        keyed([1], [[0, 0, 0, 0, 0, 0, 0]])
    with pytest.raises(InputError, match="unknown"):
        head_motion_of("dance")


def test_a_field_is_the_distance_and_pushes_out() -> None:
    field = surface_field(BALL, spacing=0.004)
    points = np.random.default_rng(1).normal(0, 0.06, (400, 3))
    exact = signed_distances(BALL.positions, triangles=BALL.triangles, queries=points).distance
    near = np.linalg.norm(points, axis=1) < RADIUS_M + 0.015
    assert field.distance(points)[near] == pytest.approx(exact[near], abs=0.0015)
    out = field.pushed(points[near], keep=np.full(near.sum(), 0.005))
    assert signed_distances(BALL.positions, triangles=BALL.triangles, queries=out).distance.min() > 0.003
    with pytest.raises(InputError, match="spacing"):
        surface_field(BALL, spacing=0.0005)
