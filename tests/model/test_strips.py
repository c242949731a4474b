"""Strips: what is refused, how they follow their surface, and what there is to see of them."""

from dataclasses import replace

import numpy as np
import pytest
from documents import hairdos, strips
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from tress.base.errors import InputError
from tress.kernel import nurbs
from tress.kernel.curves import reversed_knots, uniform_knots
from tress.model.atlas import Atlas
from tress.model.attachment import Attachment
from tress.model.document import Document
from tress.model.evaluate import evaluate
from tress.model.group import Group
from tress.model.head import Head
from tress.model.keyframes import Keyframes
from tress.model.mesh import Mesh
from tress.model.strip import Strip
from tress.model.strip_grid import strip_grid
from tress.model.strip_mesh import strips_mesh
from tress.model.strip_set import kernel_patches, posed_points, strip_set
from tress.model.strips import locked_by, strip_names, visible_strips

LAX = settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
RANDOM = np.random.default_rng(5)
NET = RANDOM.normal(0, 0.05, (5, 4, 3))
TETRAHEDRON = Mesh(
    positions=0.1 * np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]),
    triangles=[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
)


def strip(**changes):
    knots = {"knots_u": uniform_knots(5, degree=3), "knots_v": uniform_knots(4, degree=2)}
    return Strip(**{"points": NET, "weights": np.ones((5, 4)), **knots} | changes)


def root(triangle=1):
    return Attachment(surface="head", triangle=triangle, barycentric=[0.2, 0.3, 0.5], offset=[0.01, 0, 0.002])


def headed(mesh, **records):
    return Document({"head": Head(mesh=mesh, shape=[], expression=[]), **records})


def refined_rows(count):
    return {"points": np.zeros((count, 4, 3)), "weights": np.ones((count, 4))}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"knots_u": [0, 0, 0, 0, 0.5, 0.4, 1, 1, 1]}, "Strip.knots_u decreases from 0.5 to 0.4"),
        ({"knots_u": [0, 0, 1, 1, 1]}, "Strip.knots_u has 5 knots for 5 points; at least 7"),
        ({"knots_u": np.linspace(0, 1, 12)}, "which is degree 6; degree 1 to 4"),
        ({**refined_rows(9), "knots_u": np.linspace(0, 1, 18)}, "degree 8; degree 1 to 7"),
        ({"knots_v": np.ones(7)}, "Strip.knots_v spans nothing, from 1.0 to 1.0"),
        ({"knots_u": [0.5, 0.5, 0.5, 0.5, 0.5, 0.6, 0.7, 0.8, 0.9]}, "repeats 0.5 5 times; at most 4"),
        ({**refined_rows(9), "knots_u": [0, 0, 0, 0, 1, 1, 1, 1, 2, 3, 3, 3, 3]}, "repeats 1.0 4 times; at most 3"),
        ({"knots_u": [0, 0, 0, 0, np.nan, 1, 1, 1, 1]}, "not finite"),
        ({"weights": np.zeros((5, 4))}, "weights holds 0.0; numbers above 0"),
        ({"weights": -np.ones((5, 4))}, "weights holds -1.0"),
        ({"weights": np.ones((4, 4))}, "was expected"),
        ({"points": [*NET[:4].tolist(), NET[4, :3].tolist()]}, "not a rectangular array"),
        ({"points": np.where(NET > 0, np.nan, NET)}, "not finite"),
        ({"region": -1}, "region is -1"),
        ({"root": "head"}, "Attachment"),
    ],
)
def test_strips_refuse(changes, message):
    with pytest.raises(InputError, match=message):
        strip(**changes)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"triangle": -1}, "triangle is -1"),
        ({"barycentric": [0.5, 0.5, 0.5]}, "adds up to 1.5"),
        ({"barycentric": [0.5, 0.5]}, r"\(3\) was expected"),
    ],
)
def test_attachments_refuse(changes, message):
    with pytest.raises(InputError, match=message):
        replace(root(), **changes)


@pytest.mark.parametrize(
    ("records", "message"),
    [
        ({"a": strip(root=root())}, "attached to 'head', which is absent"),
        ({"head": Group(), "a": strip(root=root())}, "'head', which is a Group"),
        ({"head": TETRAHEDRON, "a": strip(root=root(triangle=4))}, "triangle 4 of 'head'; 0 to 3"),
        ({"a": strip(group="b")}, "belongs to 'b', which is no group"),
        ({"a": strip(atlas="b")}, "covered with 'b', which is no atlas"),
        (
            {"a": strip(atlas="b", region=1), "b": Atlas(color=np.zeros((1, 1, 4), np.uint8), regions=[[0, 0, 1, 1]])},
            "region 1 of 'b'; 0 to 0",
        ),
        ({"a": Group(parent="b")}, "lies in 'b', which is no group"),
        ({"a": Group(parent="b"), "b": Group(parent="a")}, "lies within itself"),
    ],
)
def test_documents_refuse_what_hangs_in_the_air(records, message):
    with pytest.raises(InputError, match=message):
        Document(records)


@LAX
@given(strips(roots=st.none()), st.integers(1, 4), st.integers(1, 3))
def test_grids_reproduce_planes_and_their_rows_are_means(patch, along, across):
    grid = strip_grid([patch], pieces=(along, across))
    assert np.asarray(grid.weights.sum(axis=1)).ravel() == pytest.approx(np.ones(len(grid.fraction)))
    assert grid.weights.min() >= 0
    assert (grid.fraction[0].tolist(), grid.fraction[-1].tolist()) == ([0, 0], [1, 1])
    assert len(grid.triangles) % 2 == 0 and grid.triangles.max() == len(grid.fraction) - 1


def test_without_weights_a_grid_is_scipys_tensor_spline():
    from scipy.interpolate import NdBSpline

    patch = strip()
    spline = NdBSpline((patch.knots_u, patch.knots_v), NET, patch.degrees)
    grid = strip_grid([patch])
    assert grid.points(NET.reshape(-1, 3)) == pytest.approx(spline(grid.fraction), abs=1e-15)


@LAX
@given(st.lists(strips(roots=st.none()), min_size=1, max_size=4), st.integers(0, 2**32))
def test_grids_are_what_the_kernel_evaluates(patches, seed):
    patches = [replace(patch, points=np.random.default_rng(seed).normal(size=patch.points.shape)) for patch in patches]
    grid = strip_grid(patches)
    found = grid.points(np.concatenate([patch.points.reshape(-1, 3) for patch in patches]))
    ends = np.array([[patch.knots_u[p], patch.knots_v[q]] for patch in patches for p, q in [patch.degrees]])
    tops = np.array([[patch.knots_u[-p - 1], patch.knots_v[-q - 1]] for patch in patches for p, q in [patch.degrees]])
    uv = ends[grid.strip] + (tops - ends)[grid.strip] * grid.fraction
    uv = np.clip(uv, ends[grid.strip], tops[grid.strip])
    wanted = nurbs.evaluate(kernel_patches(patches), uv=uv, index=grid.strip.astype(np.int64))
    steepness = max(patch.weights.max() / patch.weights.min() for patch in patches)
    assert found == pytest.approx(wanted, rel=1e-12, abs=1e-13 * (10 + steepness))


def test_a_rational_quadratic_draws_a_circle():
    half = np.sqrt(0.5)
    corner = np.array([[1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    patch = Strip(
        points=np.stack([corner, corner + [0, 0, 1]], axis=1),
        weights=np.array([[1, 1], [half, half], [1, 1]]),
        knots_u=[0, 0, 0, 1, 1, 1],
        knots_v=[0, 0, 1, 1],
    )
    points = strip_grid([patch], pieces=(16, 1)).points(patch.points.reshape(-1, 3))
    assert np.linalg.norm(points[:, :2], axis=1) == pytest.approx(np.ones(34), abs=1e-15)


def test_reversed_knots_belong_to_the_reversed_net():
    patch = strip(knots_u=[0, 0.1, 0.1, 0.4, 0.5, 1, 1.5, 1.5, 2], weights=RANDOM.uniform(0.5, 2, (5, 4)))
    back = strip(
        points=patch.points[::-1],
        weights=patch.weights[::-1],
        knots_u=reversed_knots(patch.knots_u, 0.4, 1),
        knots_v=patch.knots_v,
    )
    grids = [strip_grid([item], pieces=(2, 2)) for item in (patch, back)]
    first, second = (
        grid.points(item.points.reshape(-1, 3)).reshape(-1, 5, 3)
        for grid, item in zip(grids, (patch, back), strict=True)
    )
    assert first == pytest.approx(second[::-1], abs=1e-14)


def test_attached_strips_follow_a_head_that_turns_and_shifts():
    turn, shift = Rotation.from_euler("xyz", [0.4, -1.1, 2.0]).as_matrix(), np.array([0.3, -0.1, 0.2])
    moved = replace(TETRAHEDRON, positions=TETRAHEDRON.positions @ turn.T + shift)
    records = {"a": strip(root=root()), "b": strip(root=root(triangle=3)), "free": strip()}
    before, after = (
        posed_points(strip_set(headed(mesh, **records), ["a", "b", "free"])) for mesh in (TETRAHEDRON, moved)
    )
    assert after[:40] == pytest.approx(before[:40] @ turn.T + shift, abs=1e-7)  # positions of a head are float32
    assert np.array_equal(after[40:], before[40:])


def test_attached_strips_follow_a_morph_as_the_frame_of_their_triangle_does():
    morphed = replace(TETRAHEDRON, positions=TETRAHEDRON.positions * [1.2, 0.9, 1.5] + [0, 0.02, 0])
    document = headed(morphed, a=strip(root=root()))
    p0, p1, p2 = morphed.positions[morphed.triangles[1]].astype(float)
    x = (p1 - p0) / np.linalg.norm(p1 - p0)
    z = np.cross(p1 - p0, p2 - p0)
    z /= np.linalg.norm(z)
    origin = 0.2 * p0 + 0.3 * p1 + 0.5 * p2 + 0.01 * x + 0.002 * z
    wanted = origin + NET @ np.stack([x, np.cross(z, x), z])
    assert posed_points(strip_set(document, ["a"])).reshape(NET.shape) == pytest.approx(wanted, abs=1e-15)


def test_a_root_without_area_is_refused():
    flat = replace(TETRAHEDRON, positions=TETRAHEDRON.positions * [1, 0, 0])
    with pytest.raises(InputError, match="Triangle 1 has no area"):
        evaluate(headed(flat, a=strip(root=root())))


def test_a_group_is_one_mesh_and_a_strip_alone_is_its_own():
    records = {"a": strip(group="g"), "b": strip(group="g"), "c": strip(), "g": Group(), "empty": Group()}
    meshes = evaluate(Document(records)).meshes
    assert list(meshes) == ["c", "g"]
    assert len(meshes["g"].positions) == 2 * len(meshes["c"].positions)
    assert np.array_equal(np.unique(meshes["g"].vertex_attributes["strip"]), [0, 1])


def test_what_is_hidden_is_not_seen_and_locks_hold_for_all_within():
    records = {
        "outer": Group(hidden=True, locked=True),
        "inner": Group(parent="outer"),
        "a": strip(group="inner"),
        "b": strip(hidden=True),
        "c": strip(locked=True),
    }
    document = Document(records)
    assert not evaluate(document).meshes.keys() - {"c"}
    assert visible_strips(document) == ["c"]
    assert [locked_by(document, name) for name in ("a", "inner", "b", "c")] == ["outer", "outer", "", "c"]
    assert strip_names(document, ["outer", "c"]) == ["a", "c"]
    with pytest.raises(InputError, match="'wig' is absent; a strip or a group"):
        strip_names(document, ["wig"])


def test_triangles_face_along_times_across():
    rows, columns = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 4), indexing="ij")
    mesh = strips_mesh(Document({"a": strip(points=np.stack([rows, columns, 0 * rows], -1))}), names=["a"])
    corners = mesh.positions[mesh.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normal[:, 2] > 0).all() and np.abs(normal[:, :2]).max() < 1e-7
    assert np.linalg.norm(normal, axis=1).sum() / 2 == pytest.approx(1)


def test_the_root_lies_on_the_upper_edge_of_its_region():
    atlas = Atlas(color=np.zeros((2, 2, 4), np.uint8), regions=[[0, 0, 0.5, 1], [0.5, 0.25, 1, 0.75]])
    document = Document({"atlas": atlas, "a": strip(atlas="atlas", region=1)})
    mesh = strips_mesh(document, names=["a"])
    fraction, uv = mesh.vertex_attributes["fraction"][mesh.triangles], mesh.corner_uv
    assert uv[..., 1] == pytest.approx(0.75 - 0.5 * fraction[..., 0])
    assert uv[..., 0] == pytest.approx(0.5 + 0.5 * fraction[..., 1])
    assert mesh.texture.pixels.shape == (2, 2, 4)
    mixed = {"atlas": atlas, "g": Group(), "a": strip(group="g"), "b": strip(group="g", atlas="atlas")}
    with pytest.raises(InputError, match=r"'g' are covered with several atlases \(none, atlas\)"):
        Document(mixed)


def test_positions_replace_displacements_add_and_groups_move_all_within():
    place = RANDOM.normal(size=(1, 5, 4, 3))
    records = {
        "outer": Group(),
        "g": Group(parent="outer"),
        "a": strip(root=root(), group="g"),
        "pose": Keyframes(target="a", times=[0], values=place, kind="position"),
        "own": Keyframes(target="a", times=[0], values=np.full((1, 5, 4, 3), 0.25)),
        "up": Keyframes(target="g", times=[0], values=[[[[0, 1, 0]]]], frame="head"),
        "down": Keyframes(target="outer", times=[0], values=[[[[0, -3, 0]]]], frame="head"),
    }
    document = headed(TETRAHEDRON, **records)
    still = headed(TETRAHEDRON, a=strip(root=root(), points=place[0] + 0.25))
    found, wanted = (posed_points(strip_set(item, ["a"])) for item in (document, still))
    assert found == pytest.approx(wanted + [0, -2, 0], abs=1e-14)


@LAX
@given(hairdos(), st.floats(-20, 20))
def test_many_strips_at_once_are_each_strip_alone(records, time):
    document = Document(records)
    names = ["strip", "strip_b"]
    together = strip_set(document, names)
    alone = [posed_points(strip_set(document, [name]), time) for name in names]
    assert np.array_equal(posed_points(together, time), np.concatenate(alone))
