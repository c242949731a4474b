"""Table 1 of the paper, closed forms of sweeps, frames that neither flip nor twist, profiles that users draw."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tress.base.errors import InputError, ParameterError
from tress.kernel import nurbs
from tress.kernel.nurbs import Patch, Patches
from tress.methods.cartoon.clump import ClumpShape, clumps
from tress.methods.cartoon.frames import frames
from tress.methods.cartoon.key_hairs import KeyHairs, key_hairs
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.profile import closed_spline, ellipse, polygon

# hairLength, numHairPoints, vertRadius, horizRadius, pointiness
TABLE_1 = {
    "A": (1.0, 16, 0.1, 1.0, 0.0),
    "B": (1.0, 16, 1.0, 1.0, 1.0),
    "C": (1.0, 16, 1.0, 2.0, 0.2),
    "D": (1.0, 30, 1.0, 1.0, 0.2),
    "E": (0.4, 8, 1.0, 1.0, 0.2),
}
LENGTH = 10.0


def sheet() -> Patch:
    """Flat, hairs along +Y, normals +Z."""
    return nurbs.patch([[[0, 0, 0], [-2, 0, 0]], [[0, LENGTH, 0], [-2, LENGTH, 0]]], degree_u=1, degree_v=1)


def column(name: str) -> tuple[KeyHairs, Patch, ClumpParams]:
    length, points, vertical, horizontal, pointiness = TABLE_1[name]
    hairs = key_hairs(sheet(), params=KeyHairParams(hairs=2, points=points, length=length))
    params = ClumpParams(vertical_radius=vertical, horizontal_radius=horizontal, pointiness=pointiness)
    return hairs, clumps(hairs, params=params)[0], params


@pytest.mark.parametrize("name", TABLE_1)
def test_columns_of_table_1(name: str) -> None:
    length, points, vertical, horizontal, pointiness = TABLE_1[name]
    hairs, clump, _ = column(name)
    assert hairs.points.shape == (2, points, 3)
    assert hairs.points[0, :, 1] == pytest.approx(np.linspace(0, length * LENGTH, points))
    for along in (0.05, 0.3, 0.5, 0.95):
        ring = nurbs.evaluate(clump, uv=np.column_stack([np.full(64, along), -np.arange(64) / 64]))
        y = ring[:, 1].mean()
        assert np.ptp(ring[:, 1]) < 1e-12
        part = y / (length * LENGTH)
        if part < 1 - pointiness - 4 / points:  # away from the taper's start, which the cubic rounds off
            assert np.hypot(ring[:, 0] / horizontal, ring[:, 2] / vertical) == pytest.approx(np.ones(64), abs=1e-12)
        elif part > 1 - pointiness + 4 / points:
            scale = (1 - part) / pointiness
            assert np.abs(ring[:, 0]).max() == pytest.approx(scale * horizontal, rel=0.02)
            assert np.abs(ring[:, 2]).max() == pytest.approx(scale * vertical, rel=0.02)


def test_a_flat_end_is_closed_by_a_lid_and_a_point_needs_none() -> None:
    for name, reach in (("A", 1.0), ("B", 0.0)):
        _, clump, _ = column(name)
        u = clump.domain_u[1]
        tip = nurbs.evaluate(clump, uv=np.column_stack([np.full(16, u), -np.arange(16) / 16]))
        assert tip == pytest.approx(np.tile([0, LENGTH, 0], (16, 1)), abs=1e-3)
        ring = nurbs.evaluate(clump, uv=np.column_stack([np.full(16, 1.0), -np.arange(16) / 16]))
        assert np.abs(ring[:, 0]).max() == pytest.approx(reach, abs=1e-3)


def test_normals_point_outwards() -> None:
    _, clump, _ = column("C")
    uv = np.column_stack([np.full(32, 0.4), -np.arange(32) / 32])
    outwards = nurbs.evaluate(clump, uv=uv) * [1, 0, 1]
    assert (np.einsum("ni,ni->n", nurbs.normals(clump, uv=uv), outwards) > 0).all()


def test_key_hairs_turn_with_their_options() -> None:
    plain = key_hairs(sheet(), params=KeyHairParams(hairs=3, points=5))
    back = key_hairs(sheet(), params=KeyHairParams(hairs=3, points=5, root="last", side="back"))
    assert back.points == pytest.approx(plain.points[:, ::-1])
    assert back.normals == pytest.approx(-plain.normals)
    across = key_hairs(sheet(), params=KeyHairParams(hairs=3, points=5, along="v"))
    assert across.points[0, :, 0] == pytest.approx(np.linspace(0, -2, 5))
    assert across.normals == pytest.approx(plain.normals[:1, :1].repeat(3, 0).repeat(5, 1))


def test_jitter_stays_on_the_surface_and_is_the_seed_s() -> None:
    shifted = [key_hairs(sheet(), params=KeyHairParams(hairs=9, jitter=1.0, seed=seed)).points for seed in (1, 1, 2)]
    assert (shifted[0] == shifted[1]).all() and (shifted[0] != shifted[2]).any()
    across = shifted[0][:, 0, 0]
    assert (np.diff(across) <= 0).all() and across.min() >= -2 and across.max() <= 0


@pytest.mark.parametrize(("wrong", "value"), [("hairs", 1), ("points", 3), ("length", 1.1), ("length", -0.1)])
def test_bad_key_hairs_are_refused(wrong: str, value: float) -> None:
    with pytest.raises(ParameterError, match=wrong):
        KeyHairParams(**{wrong: value})


@pytest.mark.parametrize(
    ("wrong", "value"), [("vertical_radius", 0.0), ("horizontal_radius", -1.0), ("pointiness", 2.0)]
)
def test_bad_clumps_are_refused(wrong: str, value: float) -> None:
    with pytest.raises(ParameterError, match=wrong):
        ClumpParams(**{wrong: value})


def helix(turns: float, rise: float, count: int = 80) -> np.ndarray:
    t = np.linspace(0, 1, count)
    return np.column_stack([np.cos(turns * t), np.sin(turns * t), rise * t])


def rotation_minimising(points: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Normals by SciPy's rotations, one least rotation after another."""
    from scipy.spatial.transform import Rotation

    steps = np.diff(points, axis=0)
    along = steps / np.linalg.norm(steps, axis=1, keepdims=True)
    normals = [first]
    for before, after in pairwise(along):
        axis = np.cross(before, after)
        angle = np.arctan2(np.linalg.norm(axis), before @ after)
        unit = axis / max(np.linalg.norm(axis), 1e-12)
        normals.append(Rotation.from_rotvec(angle * unit).apply(normals[-1]))
    return np.array(normals)


def test_frames_without_normals_are_rotation_minimising() -> None:
    points = helix(5.0, 2.0)
    found = frames(points[None], normals=np.zeros((1, 80, 3)))
    wanted = rotation_minimising(points, found.normal[0, 0])
    assert found.normal[0, :-1] == pytest.approx(wanted, abs=1e-9)


@given(st.floats(-6, 6), st.floats(0.2, 3), st.integers(0, 2**16))
def test_frames_are_right_angled_and_never_flip(turns: float, rise: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = helix(turns, rise) + rng.normal(0, 1e-5, (80, 3))
    normals = rng.normal(size=3) + 0.3 * helix(2 * turns, rise)
    found = frames(points[None], normals=np.where(rng.random((80, 1)) < 0.3, -1, 1)[None] * normals[None])
    axes = np.stack([found.along[0], found.normal[0], found.across[0]], axis=1)
    assert np.einsum("pij,pkj->pik", axes, axes) == pytest.approx(np.tile(np.eye(3), (80, 1, 1)), abs=1e-9)
    assert np.linalg.det(axes) == pytest.approx(-np.ones(80) * np.sign(-np.linalg.det(axes[0])), abs=1e-9)
    assert (np.einsum("pi,pi->p", found.normal[0, 1:], found.normal[0, :-1]) > 0).all()


def test_an_inflected_and_a_vertical_hair_keep_their_sides() -> None:
    t = np.linspace(0, 1, 40)
    inflected = np.column_stack([0.3 * np.sin(2 * np.pi * t), -t, 0 * t])
    vertical = np.column_stack([0 * t, -t, 0 * t])
    up = np.tile([0.0, 1.0, 0.0], (40, 1))
    level = np.tile([0.0, 0.0, 1.0], (40, 1))
    found = frames(np.stack([inflected, vertical, vertical]), normals=np.stack([level, up, level]))
    assert found.normal[[0, 2]] == pytest.approx(np.stack([level, level]))
    assert np.ptp(found.normal[1], axis=0).max() < 1e-12 and np.isfinite(found.across).all()


def test_a_collapsed_edge_still_has_clumps() -> None:
    fan = nurbs.patch([[[0, 0, 0]] * 4, [[x, -1, 0.2 * x * x] for x in (-1, 0, 1, 2)]], degree_u=1, degree_v=3)
    hairs = key_hairs(fan, params=KeyHairParams(hairs=5))
    for clump in clumps(hairs, params=ClumpParams(vertical_radius=0.05, horizontal_radius=0.1)):
        nurbs.check(Patches.of([clump]))
        assert np.isfinite(clump.points).all()


def test_drawn_profiles_are_swept() -> None:
    drop = closed_spline([(1.5, 0), (0.5, 1), (-0.5, 1), (-1, 0), (0, -0.4)])
    square = polygon([(1, 1), (-1, 1), (-1, -1), (1, -1)])
    hairs = key_hairs(sheet(), params=KeyHairParams(hairs=2, points=8))
    params = ClumpParams(vertical_radius=1, horizontal_radius=1, pointiness=0)
    for profile in (drop, square):
        clump = clumps(hairs, params=params, shape=ClumpShape(root=profile))[0]
        low, high = clump.domain_v
        ring = nurbs.evaluate(clump, uv=np.column_stack([np.full(60, 0.5), high - (high - low) * np.arange(60) / 60]))
        across = frames(hairs.points, normals=hairs.normals).across[0, 0]
        seen = np.column_stack([ring @ across, ring[:, 2]])
        assert seen == pytest.approx(profile.at(60), abs=1e-9)


def test_one_profile_turns_into_the_other() -> None:
    square = polygon([(1, 1), (-1, 1), (-1, -1), (1, -1)])
    hairs = key_hairs(sheet(), params=KeyHairParams(hairs=2, points=8))
    params = ClumpParams(vertical_radius=1, horizontal_radius=1, pointiness=0)
    clump = clumps(hairs, params=params, shape=ClumpShape(root=ellipse(), tip=square))[0]
    low, high = clump.domain_v
    v = low + (high - low) * np.arange(160) / 160
    ends = [nurbs.evaluate(clump, uv=np.column_stack([np.full(160, u), v])) for u in (0.0, 1.0)]
    radius = [np.hypot(ring[:, 0], ring[:, 2]) for ring in ends]
    assert radius[0] == pytest.approx(np.ones(160), abs=0.01)
    assert radius[1].max() > 1.25 and radius[1].min() == pytest.approx(1, abs=0.05)


def test_radii_and_tip_shapes_scale_the_rings() -> None:
    hairs = key_hairs(sheet(), params=KeyHairParams(hairs=2, points=33))
    params = ClumpParams(vertical_radius=1, horizontal_radius=1, pointiness=0.5)
    thick = ClumpShape(radii=(1, 2, 1), tip_shape=[(0, 1), (0.5, 0.9), (1, 0)])
    clump = clumps(hairs, params=params, shape=thick)[0]
    widths = {y: np.abs(clump.points[3 + 32 * y // 4, :, 0]).max() for y in (0, 1, 2, 3)}
    assert widths == pytest.approx({0: 1, 1: 1.5, 2: 2, 3: 1.5 * 0.9})


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([(0, 0), (1, 1), (1, 0), (0, 1)], "enclose an area"),
        ([(0, 0), (2, 2), (2, 0), (0, 1)], "crosses itself"),
        ([(0, 0), (1, 1)], "3 or more"),
        ([(0, 0), (1, np.nan), (1, 0)], "not finite"),
    ],
)
def test_profiles_that_are_none_are_refused(points: list[tuple[float, float]], words: str) -> None:
    with pytest.raises(InputError, match=words):
        polygon(points)
