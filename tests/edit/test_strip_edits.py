"""Edits of strips: what they promise, and what they refuse."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from strip_hair import BALL, MOTION, POSE, RADIUS_M, SCALP, WIND, hairdo, rooted

from tress.base.errors import InputError, ParameterError
from tress.base.report import Report
from tress.edit.attach import attach
from tress.edit.clearances import clearances
from tress.edit.comb import comb
from tress.edit.cover import cover
from tress.edit.delete import delete
from tress.edit.detach import detach
from tress.edit.displace import displace
from tress.edit.duplicate import duplicate
from tress.edit.group import group
from tress.edit.hide import hide
from tress.edit.keyframe import set_keyframes
from tress.edit.knots import set_knots
from tress.edit.layer import layer
from tress.edit.lock import lock
from tress.edit.mirror import mirror
from tress.edit.push_out import push_out
from tress.edit.refine import refine
from tress.edit.surface_distance import skin
from tress.edit.transform import transform
from tress.edit.ungroup import ungroup
from tress.edit.variation import Variation
from tress.edit.weights import set_weights
from tress.model.diff import apply
from tress.model.document import Document
from tress.model.evaluate import evaluate
from tress.model.group import Group
from tress.model.strip_axes import strip_axes
from tress.model.strip_grid import strip_grid
from tress.model.strip_set import posed_points, resting_points, strip_set
from tress.model.strip_shapes import flat_strip
from tress.model.strips import strip_names

RANDOM = np.random.default_rng(7)


def points(document, name, time=None):
    strips = strip_set(document, [name])
    found = resting_points(strips) if time is None else posed_points(strips, time)
    return strips.nets(found)[0]


def changed(edit, document, **settings):
    return apply(edit(document, **settings), document)


def added(diff, prefix):
    return sorted(name for name in diff.added if name.startswith(prefix))


# Displacing


@pytest.mark.parametrize("frame", ["world", "head", "root", "strip"])
def test_a_displaced_point_moves_along_the_axes_asked_for_and_no_other_does(frame):
    document = hairdo()
    step = np.array([0.01, 0.02, -0.005])
    axes = {
        "world": np.eye(3),
        "head": np.eye(3),
        "root": strip_set(document, ["a"]).frames.axes[0],
        "strip": strip_axes(points(document, "a")),
    }[frame]
    after = changed(displace, document, points={"a": [[3, 1]]}, by=step, frame=frame)
    moved = points(after, "a") - points(document, "a")
    assert moved[3, 1] == pytest.approx(axes @ step, abs=1e-15)
    moved[3, 1] = 0
    assert not moved.any()
    assert after.records["b"] is document.records["b"]


def test_displacements_may_differ_from_point_to_point_and_strip_to_strip():
    document = hairdo()
    steps = {"a": RANDOM.normal(size=(2, 3)), "b": [0, 0, 1]}
    after = changed(displace, document, points={"a": [[0, 0], [7, 3]], "b": [[1, 2]]}, by=steps)
    assert points(after, "a")[[0, 7], [0, 3]] - points(document, "a")[[0, 7], [0, 3]] == pytest.approx(steps["a"])
    assert points(after, "b")[1, 2] - points(document, "b")[1, 2] == pytest.approx([0, 0, 1])


def test_with_falloff_nearer_points_go_further_and_far_ones_stay():
    document = hairdo(c=replace(rooted(SCALP[3]), points=hairdo().records["a"].points + [0, 0, 0.005]))
    radius = 0.04
    after = changed(displace, document, points={"a": [[4, 1]]}, by=(0, 0, 0.01), falloff_m=radius, others=["c"])
    centre = points(document, "a")[4, 1]
    for name in ("a", "c"):
        distance = np.linalg.norm(points(document, name) - centre, axis=-1)
        moved = points(after, name) - points(document, name)
        share = np.where(distance < radius, (1 - (distance / radius) ** 2) ** 2, 0)
        assert moved == pytest.approx(share[..., None] * [0, 0, 0.01], abs=1e-15)
    assert after.records["b"] is document.records["b"]


# Weights and knots


def test_weights_and_knots_are_set():
    document = hairdo()
    after = changed(set_weights, document, names=["tuft"], weights=3.0, points=[[1, 1], [2, 2]])
    assert after.records["a"].weights[[1, 2], [1, 2]].tolist() == [3, 3]
    assert after.records["a"].weights[0, 0] == document.records["a"].weights[0, 0]
    knots = [0, 0, 0, 0, 0.1, 0.2, 0.3, 0.9, 1, 1, 1, 1]
    assert changed(set_knots, document, names=["a"], knots_u=knots).records["a"].knots_u.tolist() == knots


def test_refining_leaves_surface_and_motion_as_they_are():
    document = hairdo(motion=MOTION, pose=replace(POSE, target="a"), wind=replace(WIND, values=WIND.values[:, :1]))
    after = changed(refine, document, names=["tuft"], knots_u=[0.1, 0.5, 0.55], knots_v=[0.5])
    assert after.records["a"].weights.shape == (11, 5)
    for name in ("a", "b"):
        samples = []
        for state in (document, after):
            strips = strip_set(state, [name])
            grid = strip_grid(strips.records, pieces=(840, 2) if state is document else (840, 1))
            at = grid.fraction.tolist()
            samples.append(dict(zip(map(tuple, np.round(at, 9)), grid.points(posed_points(strips, 0.3)), strict=True)))
        shared = samples[0].keys() & samples[1].keys()
        assert len(shared) > 100
        assert max(np.abs(samples[0][key] - samples[1][key]).max() for key in shared) < 1e-12


# Copies


def test_copies_are_like_their_originals_and_move_like_them():
    document = hairdo(motion=MOTION)
    diff = duplicate(document, names=["tuft"], count=2)
    after = apply(diff, document)
    assert added(diff, "a_") + added(diff, "b_") == ["a_1", "a_2", "b_1", "b_2"]
    assert after.records["a_2"] == document.records["a"]
    assert np.array_equal(points(after, "b_1", 0.4), points(after, "b", 0.4))


def test_varied_copies_keep_what_is_not_varied():
    document = hairdo()
    flat = document.records["pattern"]

    def copy(**ranges):
        return changed(duplicate, document, names=["pattern"], variation=Variation(**ranges), seed=4).records[
            "pattern_1"
        ]

    def lengths(strip):
        return np.linalg.norm(np.diff(strip.points.mean(axis=1), axis=0), axis=1)

    longer = copy(length_low=2, length_high=2)
    assert longer.points == pytest.approx(flat.points * [2, 1, 1], abs=1e-15)
    assert copy(width_low=0.5, width_high=0.5).points == pytest.approx(flat.points * [1, 0.5, 1], abs=1e-15)
    turned = copy(turn_low=0.3, turn_high=0.3)
    assert turned.points == pytest.approx(flat.points @ Rotation.from_euler("z", 0.3).as_matrix().T, abs=1e-15)
    lifted = copy(tilt_low=0.2, tilt_high=0.2).points[-1].mean(axis=0)
    assert lifted == pytest.approx([0.1 * np.cos(0.2), 0, 0.1 * np.sin(0.2)], abs=1e-15)
    curled = copy(curl_low=2, curl_high=2)
    assert lengths(curled) == pytest.approx(lengths(flat), abs=1e-15)
    tip = np.diff(curled.points.mean(axis=1), axis=0)[-1]
    assert np.arctan2(tip[2], tip[0]) == pytest.approx(2 * 13 / 14)
    assert np.ptp(copy(weight_low=0.5).weights) > 0.1
    warped = copy(knot_low=2, knot_high=2)
    assert warped.knots_u == pytest.approx(flat.knots_u**2)
    shifted = copy(location_m=0.05).points - flat.points
    assert np.ptp(shifted, axis=(0, 1)) == pytest.approx(0, abs=1e-15) and shifted[0, 0, 2] == 0


def test_the_same_seed_gives_the_same_copies_and_another_seed_others():
    document, variation = hairdo(), Variation(location_m=0.02, turn_low=-1, turn_high=1, length_low=0.5)
    first, again, other = (
        duplicate(document, names=["tuft"], count=3, variation=variation, seed=seed) for seed in (1, 1, 2)
    )
    assert first == again != other


def test_a_root_that_moves_stays_on_the_surface_and_the_strip_turns_with_it():
    document = hairdo()
    after = changed(duplicate, document, names=["a"], count=20, variation=Variation(location_m=0.05), into="tuft")
    before = strip_set(document, ["a"])
    for number in range(1, 21):
        strips = strip_set(after, [f"a_{number}"])
        record = after.records[f"a_{number}"]
        assert np.linalg.norm(record.root.offset) == pytest.approx(0.001)
        height = np.linalg.norm(strips.frames.origins[0])
        assert height == pytest.approx(RADIUS_M + 0.001, abs=0.002)
        # Seen from its normal, the strip lies as before.
        normals = [item.frames.axes[0][:, 2] for item in (before, strips)]
        tips = [item.nets(resting_points(item))[0][-1, 0] - item.frames.origins[0] for item in (before, strips)]
        assert normals[0] @ tips[0] == pytest.approx(normals[1] @ tips[1], abs=1e-12)
        assert np.linalg.norm(tips[0]) == pytest.approx(np.linalg.norm(tips[1]))


def test_a_mirror_image_is_the_image_of_every_point_at_every_time():
    document = hairdo(motion=MOTION, pose=replace(POSE, target="a"), sway=replace(MOTION, frame="head"))
    diff = mirror(document, names=["a", "b", "pattern"], normal=(1, 0, 0.5), distance_m=0.01)
    after = apply(diff, document)
    axis = np.array([1, 0, 0.5]) / np.linalg.norm([1, 0, 0.5])
    for name in ("a", "b", "pattern"):
        for time in (0.0, 0.6):
            net = points(document, name, time)
            image = net - 2 * (net @ axis - 0.01)[..., None] * axis
            assert points(after, f"{name}_1", time) == pytest.approx(image[:, ::-1], abs=1e-14)
    root = after.records["a_1"].root
    assert root.surface == "head" and abs(root.offset[:2]).max() < 1e-9


# Attaching


def test_each_triangle_gets_a_copy_along_its_normal_and_the_flow():
    document = hairdo()
    flow = np.cross(BALL.positions, [0, 1, 0]) + [0, -0.05, 0]
    diff = attach(document, names=["pattern"], surface="head", triangles=SCALP[::5], into="cap", flow=flow)
    after = apply(diff, document)
    copies = added(diff, "pattern_")
    assert len(copies) == len(SCALP[::5]) and diff.added["cap"] == Group()
    assert list(evaluate(after).meshes) == ["cap", "head", "pattern", "tuft"]
    for name in copies:
        strip = after.records[name]
        corners = BALL.positions[BALL.triangles[strip.root.triangle]].astype(float)
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        normal /= np.linalg.norm(normal)
        net = points(after, name)
        assert net[0].mean(axis=0) == pytest.approx(corners.mean(axis=0), abs=1e-9)
        axes = strip_axes(net)
        assert axes[:, 2] == pytest.approx(normal, abs=1e-9)
        wanted = flow[BALL.triangles[strip.root.triangle]].mean(axis=0)
        wanted -= (wanted @ normal) * normal
        assert axes[:, 0] == pytest.approx(wanted / np.linalg.norm(wanted), abs=1e-6)


def test_attached_copies_follow_a_morphed_head():
    document = changed(attach, hairdo(), names=["pattern"], surface="head", triangles=SCALP, into="cap")
    head = document.records["head"]
    turn = Rotation.from_euler("xyz", [0.3, 0.2, -0.7]).as_matrix()
    turned = replace(head, mesh=replace(BALL, positions=BALL.positions @ turn.T + [0, 0.1, 0]))
    names = [name for name in document.records if name.startswith("pattern_")]
    before = resting_points(strip_set(document, names))
    after = resting_points(strip_set(Document({**document.records, "head": turned}), names))
    assert after == pytest.approx(before @ turn.T + [0, 0.1, 0], abs=1e-6)
    grown = replace(head, mesh=replace(BALL, positions=BALL.positions * 1.3))
    strips = strip_set(Document({**document.records, "head": grown}), names)
    assert strips.frames.origins == pytest.approx(strip_set(document, names).frames.origins * 1.3, abs=1e-8)


def test_detached_strips_stay_where_they_are_and_go_on_moving():
    document = hairdo(motion=MOTION, pose=replace(POSE, target="a"))
    after = changed(detach, document, names=["tuft"])
    for name in ("a", "b"):
        assert after.records[name].root is None
        assert points(after, name, 0.3) == pytest.approx(points(document, name, 0.3), abs=1e-14)


# Groups, locks, pictures, motion


def test_grouping_and_ungrouping_keep_the_motion():
    document = hairdo(motion=MOTION, wind=WIND)
    grouped = changed(group, document, names=["tuft", "pattern"], into="all")
    assert grouped.records["tuft"].parent == "all" and grouped.records["pattern"].group == "all"
    dissolved = changed(ungroup, grouped, names=["all", "tuft"])
    assert not dissolved.of_type(Group)
    for name in ("a", "b"):
        assert np.array_equal(points(dissolved, name, 0.3), points(document, name, 0.3))


def test_what_is_locked_refuses_every_edit_but_unlocking():
    document = changed(lock, hairdo(motion=replace(MOTION)), names=["tuft"])
    refused = [
        (displace, {"points": {"a": [[0, 0]]}, "by": (0, 0, 1)}),
        (set_weights, {"names": ["a"], "weights": 2.0}),
        (set_knots, {"names": ["a"], "knots_u": np.arange(12.0)}),
        (refine, {"names": ["a"], "knots_u": [0.5]}),
        (duplicate, {"names": ["a"]}),
        (mirror, {"names": ["tuft"]}),
        (attach, {"names": ["a"], "surface": "head", "triangles": SCALP[:1], "into": "b1"}),
        (attach, {"names": ["pattern"], "surface": "head", "triangles": SCALP[:1], "into": "tuft"}),
        (detach, {"names": ["a"]}),
        (group, {"names": ["a"], "into": "other"}),
        (group, {"names": ["pattern"], "into": "tuft"}),
        (ungroup, {"names": ["tuft"]}),
        (hide, {"names": ["a"]}),
        (cover, {"names": ["a"], "atlas": "atlas"}),
        (layer, {"outer": ["a"], "inner": ["pattern"], "surface": "head"}),
        (push_out, {"names": ["a"], "surface": "head"}),
        (set_keyframes, {"target": "a", "times": [0], "values": np.zeros((1, 1, 1, 3))}),
        (transform, {"names": ["a"], "new_from_old": np.eye(4)}),
        (delete, {"names": ["a"]}),
        (delete, {"names": ["tuft"]}),
    ]
    for edit, settings in refused:
        with pytest.raises(InputError, match="is locked( by the group 'tuft')?; unlock it to change it"):
            edit(document, **settings)
    changed(duplicate, changed(lock, document, names=["tuft"], locked=False), names=["a"])


def test_hidden_strips_are_not_seen():
    document = hairdo()
    assert list(evaluate(changed(hide, document, names=["tuft"])).meshes) == ["head", "pattern"]
    assert hide(document, names=["tuft"], hidden=False).is_empty


def test_strips_are_covered_in_turn():
    after = changed(cover, hairdo(), names=["tuft", "pattern"], atlas="atlas", regions=[1, 0])
    assert [after.records[name].region for name in ("a", "b", "pattern")] == [1, 0, 1]
    assert changed(cover, after, names=["pattern"], atlas="").records["pattern"].atlas == ""


def test_keyframes_are_set_changed_and_deleted():
    document = hairdo()
    shift = np.zeros((2, 1, 1, 3))
    first = changed(set_keyframes, document, target="tuft", times=[0, 1], values=shift, interpolation="linear")
    assert first.records["tuft_motion_1"].interpolation == "linear"
    second = changed(set_keyframes, first, target="a", name="tuft_motion_1", times=[0], values=shift[:1])
    assert second.records["tuft_motion_1"].target == "a"
    assert changed(delete, second, names=["tuft_motion_1"]) == document


def test_deleting_takes_along_what_lies_within_and_refuses_what_is_needed():
    document = hairdo(motion=MOTION, wind=WIND)
    assert set(document.records) - set(changed(delete, document, names=["tuft"]).records) == {
        "tuft", "a", "b", "motion", "wind"
    }  # fmt: skip
    with pytest.raises(InputError, match="'head' is needed by 'a'"):
        delete(document, names=["head"])
    with pytest.raises(InputError, match="'atlas' is needed by 'a'"):
        delete(changed(cover, document, names=["tuft"], atlas="atlas"), names=["atlas"])


# Distance


def test_pushed_out_strips_are_outside_at_every_sample():
    document = changed(
        attach,
        hairdo(),
        names=["pattern"],
        surface="head",
        triangles=SCALP[::4],
        into="cap",
        variation=Variation(tilt_low=-0.6, tilt_high=0.1, length_high=1.5, curl_low=-1),
        seed=2,
    )
    before = clearances(document, names=["cap"], surface="head")
    assert min(before.values()) < -0.01
    report = Report()
    after = changed(push_out, document, names=["cap"], surface="head", clearance_m=0.001, report=report)
    found = clearances(after, names=["cap"], surface="head", density=7)
    assert min(found.values()) >= 0
    assert min(clearances(after, names=["cap"], surface="head").values()) >= 0.001
    numbers = {key: value for stage in report.stages for key, value in stage.numbers.items()}
    assert numbers["strips_inside"] == sum(value < 0 for value in before.values())
    assert numbers["deepest_m"] == pytest.approx(-min(before.values()))
    assert not any(stage.warnings for stage in report.stages)
    assert push_out(after, names=["cap"], surface="head", clearance_m=0.001).is_empty


def test_strips_that_are_outside_are_left_alone():
    document = hairdo(
        far=replace(flat_strip(length_m=0.1, width_m=0.01), points=flat_strip(length_m=0.1, width_m=0.01).points + 1)
    )
    assert push_out(document, names=["far"], surface="head").is_empty


def test_an_outer_layer_comes_to_lie_on_the_inner_one():
    document = hairdo()
    kinds = Variation(turn_low=-0.3, turn_high=0.3)
    for name, seed in (("inner", 1), ("outer", 2)):
        document = changed(
            attach,
            document,
            names=["pattern"],
            surface="head",
            triangles=SCALP[::6],
            into=name,
            variation=kinds,
            seed=seed,
        )
        document = changed(push_out, document, names=[name], surface="head", clearance_m=0.002)
    report = Report()
    after = changed(layer, document, outer=["outer"], inner=["inner"], surface="head", gap_m=0.002, report=report)
    assert not any(stage.warnings for stage in report.stages)
    assert after.records["inner"] is document.records["inner"]
    assert heights_above(document) < 0.0 < 0.0019 < heights_above(after)
    again = layer(after, outer=["outer"], inner=["inner"], surface="head", gap_m=0.002)
    assert again.is_empty


def heights_above(document):
    """The least height of samples of the outer strips, away from their roots, above the inner ones."""
    from tress.kernel.geom import ray_hits
    from tress.model.strips import strip_names

    inner, outer = (strip_set(document, strip_names(document, [name])) for name in ("inner", "outer"))
    under, over = (strip_grid(item.records) for item in (inner, outer))
    samples = over.points(resting_points(outer))[over.fraction[:, 0] > 0.35]
    ways = samples / np.linalg.norm(samples, axis=1, keepdims=True)
    hits = ray_hits(
        under.points(resting_points(inner)),
        triangles=under.triangles,
        origins=samples + 0.03 * ways,
        directions=-ways,
        limit=0.033,
    )
    return (hits.t - 0.03).min()


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda d: displace(d, points={"a": [[8, 0]]}, by=(0, 0, 1)), r"8 x 4 control points; \(8, 0\) is none"),
        (lambda d: displace(d, points={"a": [[0.5, 0]]}, by=(0, 0, 1)), "whole numbers"),
        (lambda d: displace(d, points={"a": [[0, 0]]}, by=(0, 1)), "three numbers"),
        (lambda d: displace(d, points={"a": [[0, 0]]}, by=(0, 1, np.nan)), "three numbers"),
        (lambda d: displace(d, points={"a": [[0, 0]]}, by=(0, 0, 1), frame="view"), "one of world, head, root, strip"),
        (lambda d: displace(d, points={"a": [[0, 0]]}, by=(0, 0, 1), falloff_m=-1), "falloff of -1"),
        (lambda d: displace(d, points={"tuft": [[0, 0]]}, by=(0, 0, 1)), "'tuft' is a group"),
        (lambda d: displace(d, points={"head": [[0, 0]]}, by=(0, 0, 1)), "'head' is a Head; a strip or a group"),
        (lambda d: set_weights(d, names=["a"], weights=0.0), "above 0"),
        (lambda d: set_weights(d, names=["a"], weights=[1, 2, 3]), "do not fit"),
        (lambda d: set_weights(d, names=["a"], weights=np.nan), "not finite"),
        (lambda d: set_weights(d, names=["a"], weights=1.0, points=[[9, 9]]), "does not have all"),
        (lambda d: set_knots(d, names=["a"]), "No knots"),
        (lambda d: set_knots(d, names=["a"], knots_u=[0, 1]), "2 knots for 8 points"),
        (lambda d: set_knots(d, names=["a"], knots_u=np.arange(12)[::-1]), "decreases"),
        (lambda d: set_knots(d, names=["a"], knots_v=np.arange(9.0)), "degree 4; degree 1 to 3"),
        (lambda d: refine(d, names=["a"], knots_u=[2.0]), "cannot be used"),
        (lambda d: duplicate(d, names=["a"], count=0), "at least 1"),
        (lambda d: duplicate(d, names=["a"], into="nowhere"), "no group"),
        (lambda d: Variation(turn_low=1), "low <= high"),
        (lambda d: mirror(d, names=["a"], normal=(0, 0, 0)), "is none"),
        (
            lambda d: attach(d, names=["pattern"], surface="head", triangles=[99999], into="x"),
            "Triangle 99999 is not one",
        ),
        (lambda d: attach(d, names=["pattern"], surface="head", triangles=[-1], into="x"), "Triangle -1 is not one"),
        (
            lambda d: attach(d, names=["pattern"], surface="head", triangles=[len(BALL.triangles) - 1], into="x"),
            "outside the scalp of 'head'",
        ),
        (lambda d: attach(d, names=["pattern"], surface="head", triangles=[0.5], into="x"), "whole numbers"),
        (lambda d: attach(d, names=["pattern"], surface="wig", triangles=[0], into="x"), "absent; a head or a mesh"),
        (
            lambda d: attach(d, names=["pattern"], surface="head", triangles=[0], into="x", flow=[[0, 1]]),
            "flow has shape",
        ),
        (lambda d: group(d, names=["tuft"], into="tuft"), "within itself"),
        (lambda d: group(d, names=["a"], into="head"), "a group was expected"),
        (lambda d: ungroup(d, names=["a"]), "a group was expected"),
        (lambda d: cover(d, names=["a"], atlas="head"), "an atlas was expected"),
        (lambda d: cover(d, names=["a"], atlas="atlas", regions=[2]), "numbers from 0 to 1"),
        (lambda d: set_keyframes(d, target="head", times=[0], values=np.zeros((1, 1, 1, 3))), "no strip or group"),
        (lambda d: set_keyframes(d, target="a", times=[1, 0], values=np.zeros((2, 1, 1, 3))), "rising"),
        (lambda d: set_keyframes(d, target="a", name="b", times=[0], values=np.zeros((1, 1, 1, 3))), "keyframes were"),
        (lambda d: layer(d, outer=["tuft"], inner=["a"], surface="head"), "'a' is in both layers"),
        (lambda d: push_out(d, names=["a"], surface="head", clearance_m=-1), "clearance of -1"),
        (lambda d: push_out(d, names=["a"], surface="tuft"), "a head or a mesh"),
    ],
)
def test_wrong_edits_of_strips_are_refused(edit, message):
    with pytest.raises((InputError, ParameterError), match=message):
        edit(hairdo())


def test_pushed_out_strips_are_outside_a_head_with_ears_and_a_mouth():
    from tress.head.statistical import load_statistical_head

    found = load_statistical_head()
    mesh = replace(BALL, positions=found.mean, triangles=found.triangles, vertex_attributes={})
    assert len(skin(mesh).triangles) < len(mesh.triangles)
    scalp = np.flatnonzero(found.masks["scalp"][found.triangles].min(axis=1) > 0.5)
    document = Document({"head": mesh, "pattern": flat_strip(length_m=0.15, width_m=0.02)})
    kinds = Variation(tilt_low=-0.2, tilt_high=0.3, curl_low=-1.5)
    document = changed(
        attach, document, names=["pattern"], surface="head", triangles=scalp[::40], into="cap", variation=kinds
    )
    assert min(clearances(document, names=["cap"], surface="head").values()) < -0.005
    report = Report()
    after = changed(push_out, document, names=["cap"], surface="head", report=report)
    assert not report.stages[0].warnings
    assert min(clearances(after, names=["cap"], surface="head", density=5).values()) >= 0


def test_combed_strips_cling_to_a_surface_that_the_flow_leaves():
    document = changed(attach, hairdo(), names=["pattern"], surface="head", triangles=SCALP[::6], into="cap")
    away = {"names": ["cap"], "surface": "head", "flow": lambda places: np.broadcast_to([0.0, 0.3, 1.0], places.shape)}

    def farthest(cling):
        combed = changed(comb, document, **away, cling=cling)
        strips = strip_set(combed, strip_names(combed, ["cap"]))
        return np.linalg.norm(resting_points(strips), axis=1).max()

    assert farthest(1.0) < RADIUS_M + 0.03 < farthest(0.0)
    with pytest.raises(InputError, match=r"cling of 1\.5; 0 to 1 was expected"):
        comb(document, **away, cling=1.5)
