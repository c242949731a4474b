"""Surfaces of a document become clumps that follow them; chance, splits and mergers."""

import numpy as np
import pytest

from tress.base.errors import InputError
from tress.edit.clearances import clearances
from tress.kernel import nurbs
from tress.methods.cartoon.clump import swept
from tress.methods.cartoon.key_hairs import key_hairs
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.splitting import SplitParams, split
from tress.methods.cartoon.tuft import Tuft, clump_surface, tuft_clumps
from tress.methods.cartoon.variation import ClumpVariation, varied
from tress.methods.strips.edited import edited
from tress.model.document import Document
from tress.model.keyframes import Keyframes
from tress.model.mesh import Mesh
from tress.model.record import Record
from tress.model.strip import Strip
from tress.model.strip_set import posed_points, strip_set
from tress.model.strip_shapes import flat_strip
from tress.model.strips import strip_names

FLAT = flat_strip(length_m=0.3, width_m=0.2)
SHEET = nurbs.patch([[[0, 0, 0], [-2, 0, 0]], [[0, 10, 0], [-2, 10, 0]]], degree_u=1, degree_v=1)
SMALL = Tuft(hairs=KeyHairParams(hairs=4, points=6), clump=ClumpParams(pointiness=1.0))


def moving(**changes: object) -> Document:
    values = np.zeros((3, 1, 1, 3))
    values[1:, ..., 2] = [[[0.05]], [[0.1]]]
    keyframes = Keyframes(target="surface", times=[0, 1, 2], values=values, **changes)
    records: dict[str, Record] = {"surface": FLAT, "motion": keyframes}
    return Document(records)


@pytest.mark.parametrize("interpolation", ["linear", "cubic"])
def test_clumps_follow_a_moving_surface(interpolation):
    document = edited(moving(interpolation=interpolation), clump_surface, surface="surface", into="hair", tuft=SMALL)
    names = strip_names(document, ["hair"])
    assert len(names) == 4
    clumps = strip_set(document, names)
    surface = strip_set(document, ["surface"])
    for time in (0.0, 0.7, 1.0, 1.6, 2.0):
        way = posed_points(clumps, time) - posed_points(clumps, 0.0)
        expected = (posed_points(surface, time) - posed_points(surface, 0.0))[0]
        assert way == pytest.approx(np.tile(expected, (len(way), 1)), abs=1e-9)
    kept = [item for item in document.of_type(Keyframes).values() if item.kind == "position"]
    assert {item.interpolation for item in kept} == {interpolation}


def test_clumps_are_made_anew_at_every_keyframe():
    turned = FLAT.points[..., [0, 2, 1]]
    keyframes = Keyframes(target="surface", times=[0, 1], values=np.stack([FLAT.points, turned]), kind="position")
    document = Document({"surface": FLAT, "motion": keyframes})
    document = edited(document, clump_surface, surface="surface", into="hair", tuft=SMALL)
    net = posed_points(strip_set(document, strip_names(document, ["hair"])), 1.0)
    patch = nurbs.patch(turned, knots_u=FLAT.knots_u, knots_v=FLAT.knots_v)
    assert net == pytest.approx(tuft_clumps(patch, tuft=SMALL).points.reshape(-1, 3), abs=1e-12)


def test_a_surface_that_stands_still_has_clumps_without_keyframes():
    document = edited(Document({"surface": FLAT}), clump_surface, surface="surface", into="hair", tuft=SMALL)
    assert not document.of_type(Keyframes)


def test_clumps_lie_on_a_head_not_in_it():
    ball = ball_mesh(0.1)
    middle = FLAT.points * [0.5, 0.5, 1] - [0.075, 0, -0.095]
    surface = Strip(points=middle, weights=FLAT.weights, knots_u=FLAT.knots_u, knots_v=FLAT.knots_v)
    document = Document({"surface": surface, "ball": ball})
    sunk = edited(document, clump_surface, surface="surface", into="hair", tuft=SMALL)
    kept = edited(document, clump_surface, surface="surface", into="hair", tuft=SMALL, head="ball", clearance_m=0.002)
    room = [clearances(each, names=["hair"], surface="ball") for each in (sunk, kept)]
    assert min(room[0].values()) < -0.003 and min(room[1].values()) >= 0


def ball_mesh(radius: float) -> Mesh:
    from scipy.spatial import ConvexHull

    rng = np.random.default_rng(0)
    points = rng.normal(size=(600, 3))
    points *= radius / np.linalg.norm(points, axis=1, keepdims=True)
    corners = ConvexHull(points).simplices
    a, b, c = points[corners].swapaxes(0, 1)
    out = np.einsum("fi,fi->f", np.cross(b - a, c - a), a) > 0
    return Mesh(positions=points, triangles=np.where(out[:, None], corners, corners[:, ::-1]))


def test_chance_is_within_its_ranges_and_the_seed_s():
    wide = ClumpVariation(radius_low=0.5, radius_high=2, length_low=0.3, twist_low=-1, twist_high=1, lift_high=0.01)
    drawn = varied(wide, count=500)
    for values, low, high in ((drawn.radius, 0.5, 2), (drawn.length, 0.3, 1), (drawn.twist, -1, 1)):
        assert low <= values.min() < low + 0.05 * (high - low) and high - 0.05 * (high - low) < values.max() <= high
    again, other = (varied(ClumpVariation(seed=seed, radius_high=2), count=9) for seed in (0, 1))
    assert (again.radius == varied(ClumpVariation(radius_high=2, twist_high=1), count=9).radius).all()
    assert (again.radius != other.radius).any()


def test_radius_length_and_twist_of_single_clumps():
    hairs = key_hairs(SHEET, params=KeyHairParams(hairs=2, points=9), lengths=np.array([1.0, 0.5]))
    assert hairs.points[:, -1, 1] == pytest.approx([10, 5])
    params = ClumpParams(vertical_radius=0.1, horizontal_radius=1, pointiness=0)
    found = swept(hairs, params=params, radius=np.array([1.0, 0.5]), twist=np.array([0.0, np.pi / 2]))
    root, tip = found.points[:, 3], found.points[:, -4]
    assert np.ptp(root[..., 0], axis=1) == pytest.approx([2, 1]) and np.ptp(root[..., 2], axis=1) == pytest.approx(
        [0.2, 0.1]
    )
    assert np.ptp(tip[..., 0], axis=1) == pytest.approx([2, 0.1]) and np.ptp(tip[..., 2], axis=1) == pytest.approx(
        [0.2, 1]
    )


def test_a_split_shares_the_root_and_a_merger_the_tip():
    hairs = key_hairs(SHEET, params=KeyHairParams(hairs=2, points=21))
    apart = split(hairs, params=SplitParams(ways=3, apart_tip=1, begins=0.5, shorter=0.0), radius=0.5).points
    assert apart.shape == (6, 21, 3)
    assert (apart[:3, :11] == apart[:1, :11]).all()
    assert apart[:3, -1, 0] == pytest.approx([-0.5, 0, 0.5]) or apart[:3, -1, 0] == pytest.approx([0.5, 0, -0.5])
    together = split(hairs, params=SplitParams(ways=2, apart_root=1, apart_tip=0, shorter=0.0), radius=0.5).points
    assert together[0, -1] == pytest.approx(together[1, -1])
    assert np.linalg.norm(together[0, 0] - together[1, 0]) == pytest.approx(1)


def test_outer_clumps_of_a_split_are_shorter():
    hairs = key_hairs(SHEET, params=KeyHairParams(hairs=2, points=9))
    found = split(hairs, params=SplitParams(ways=3, shorter=0.25), radius=0.1)
    assert found.points[:3, -1, 1] == pytest.approx([7.5, 10, 7.5])


def test_what_is_no_surface_is_refused():
    with pytest.raises(InputError, match="'hair' is no strip"):
        clump_surface(Document({"surface": FLAT}), surface="hair", into="clumps")
    twice = edited(Document({"surface": FLAT}), clump_surface, surface="surface", into="hair", tuft=SMALL)
    with pytest.raises(InputError, match="'hair_000' is there already"):
        clump_surface(twice, surface="surface", into="hair", tuft=SMALL)


def test_upside_down_ranges_are_refused():
    with pytest.raises(InputError, match=r"radius_low is 2\.0, above radius_high 1\.0"):
        ClumpVariation(radius_low=2.0)


def test_control_points_that_are_no_numbers_are_refused():
    broken = FLAT.points.copy()
    broken[0, 0, 0] = np.nan
    with pytest.raises(InputError, match="not finite"):
        Strip(points=broken, weights=FLAT.weights, knots_u=FLAT.knots_u, knots_v=FLAT.knots_v)
