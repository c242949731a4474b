"""The rasteriser: closed forms, laws, and a second implementation that knows no tiles."""

import os
import subprocess
import sys

import numpy as np
import pytest
from kernel.reference_raster import primitive_of_samples

from tress.base.errors import InputError
from tress.kernel import raster

NO_VERTICES = np.zeros((0, 4), np.float32)
NO_TRIANGLES = np.zeros((0, 3), np.uint32)


def draw(strands=(), *, half_width=0.5, alpha=1.0, vertices=NO_VERTICES, triangles=NO_TRIANGLES, size=(64, 48), **more):
    """Fragments of strands given as lists of (x, y, depth)."""
    points = np.array([(*p, 1.0) for strand in strands for p in strand], np.float32).reshape(-1, 4)
    offsets = np.cumsum([0] + [len(strand) for strand in strands])
    return raster.rasterise(
        points,
        offsets=offsets,
        half_width_px=np.full(len(points), half_width),
        alpha=np.full(len(points), alpha),
        mesh_vertices=vertices,
        triangles=triangles,
        width=size[0],
        height=size[1],
        **more,
    )


def coverage(fragments):
    """(H, W): the share of each pixel that anything covers."""
    total = raster.composite(fragments, rgba=np.ones((len(fragments.weight), 4)))[..., 3]
    return total.astype(float)


def random_scene(seed, *, size=(64, 48)):
    rng = np.random.default_rng(seed)
    strands = [
        np.c_[np.cumsum(rng.normal(0, 4, (9, 2)), axis=0) + rng.uniform(0, size), rng.uniform(0, 1, 9)]
        for _ in range(30)
    ]
    vertices = np.c_[rng.uniform(-10, 74, (24, 2)), rng.uniform(0, 1, 24), np.ones(24)].astype(np.float32)
    return strands, vertices, rng.permutation(24).reshape(8, 3)


@pytest.mark.parametrize("angle", [0, 0.3, 0.77, np.pi / 2, 2.2])
@pytest.mark.parametrize("width", [1.0, 3.5])
def test_a_segment_covers_length_times_width(angle, width):
    direction = np.array([np.cos(angle), np.sin(angle)])
    ends = [32.13, 24.41] + np.outer([-17, 17], direction)
    total = coverage(draw([[(*ends[0], 0), (*ends[1], 0)]], half_width=width / 2)).sum()
    assert total == pytest.approx(34 * width, rel=0.03), "16 samples a pixel along both edges"


def test_a_bent_strand_covers_length_times_width_without_gaps_or_doubles():
    angles = np.linspace(0, 2, 30)
    arc = np.c_[10 + 20 * np.sin(angles), 8 + 20 * (1 - np.cos(angles)), np.zeros(30)]
    for alpha in (1.0, 0.5):
        total = coverage(draw([arc], half_width=1.0, alpha=alpha)).sum()
        assert total == pytest.approx(40 * 2 * alpha, rel=0.02 if alpha == 1 else 0.1)


def test_a_half_plane_covers_its_exact_area():
    corners = np.array([[10.25, -100, 0, 1], [10.25, 200, 0, 1], [500, 50, 0, 1]], np.float32)
    covered = coverage(draw(vertices=corners, triangles=[[0, 1, 2]]))
    assert (covered[:, :10] == 0).all()
    assert (covered[:, 10] == 0.75).all()
    assert (covered[:, 11:] == 1).all()


def test_two_triangles_share_an_edge_without_gap_or_double():
    rng = np.random.default_rng(5)
    for _ in range(20):
        a, b = rng.uniform(5, 43, (2, 2))
        square = np.array([[-50, -50], [110, -50], [110, 100], [-50, 100]])
        xy = np.concatenate([[a, b], square])
        fan = [[0, 1, 2], [0, 1, 3], [0, 1, 4], [0, 1, 5], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 2]]
        around = fan[4:]
        vertices = np.c_[xy, np.zeros(6), np.ones(6)].astype(np.float32)
        found = draw(vertices=vertices, triangles=around)
        assert (coverage(found) == 1).all()
        counted = sum(coverage(draw(vertices=vertices, triangles=[one])).sum() for one in around)
        assert counted == 64 * 48


def test_the_nearer_of_two_crossing_strands_is_seen():
    across = [(4, 24.5, 1.0), (60, 24.5, 1.0)]
    for depth, expected in ((0.5, 2), (1.5, 0)):
        down = [(32.5, 4, depth), (32.5, 44, depth)]
        found = draw([across, down])
        here = found.pixel == 24 * 64 + 32
        assert found.primitive[here].tolist() == [expected]
        assert found.weight[here].tolist() == [1.0]


def test_strands_that_pierce_each_other_change_places_at_the_crossing():
    found = draw([[(4, 24.5, 0.0), (60, 24.5, 1.0)], [(4, 24.5, 1.0), (60, 24.5, 0.0)]])
    left, right = found.pixel % 64 < 31, found.pixel % 64 > 32
    assert set(found.primitive[left]) == {0}
    assert set(found.primitive[right]) == {2}


def test_hair_behind_a_mesh_is_hidden_and_before_it_is_seen():
    sheet = np.array([[0, 0, 0.5, 1], [64, 0, 0.5, 1], [0, 96, 0.5, 1]], np.float32)
    for depth, kind in ((0.4, raster.SEGMENT), (0.6, raster.TRIANGLE)):
        found = draw([[(2, 20.5, depth), (30, 20.5, depth)]], vertices=sheet, triangles=[[0, 1, 2]])
        assert set(found.kind[found.pixel == 20 * 64 + 15]) == {kind}


def test_parameters_run_along_and_across_the_segment():
    found = draw([[(10, 20, 0), (50, 20, 1)]], half_width=4)
    along = (found.pixel % 64 + 0.5 - 10) / 40
    across = (found.pixel // 64 + 0.5 - 20) / 4
    assert np.abs(found.parameter[:, 0] - along).max() < 0.02
    assert np.abs(found.parameter[:, 1] - across).max() < 0.02
    assert np.abs(found.depth - along).max() < 0.02


def test_perspective_interpolates_in_space():
    camera = [[100, 0, -32, 64], [0, -100, -24, 48], [0, 0, -1, 2]]
    points = raster.project([[-0.3, 0, -2], [0.1, 0, 1.5]], xy_from_points=camera)
    found = draw(size=(64, 48))
    found = raster.rasterise(
        points,
        offsets=[0, 2],
        half_width_px=[1, 1],
        alpha=[1, 1],
        mesh_vertices=NO_VERTICES,
        triangles=NO_TRIANGLES,
        width=64,
        height=48,
    )
    t = found.parameter[:, 0].astype(float)
    position = np.outer(1 - t, [-0.3, -2]) + np.outer(t, [0.1, 1.5])
    x = 100 * position[:, 0] / (2 - position[:, 1]) + 32
    full = found.weight == 1
    assert full.any()
    assert np.abs(x - (found.pixel % 64 + 0.5))[full].max() < 0.06


def test_what_lies_behind_a_perspective_camera_is_not_drawn():
    camera = [[100, 0, -32, 64], [0, -100, -24, 48], [0, 0, -1, 2]]
    points = raster.project([[0, 0, 0], [0, 0.1, 3]], xy_from_points=camera)
    assert points[1, 3] == 0
    found = raster.rasterise(
        points,
        offsets=[0, 2],
        half_width_px=[1, 1],
        alpha=[1, 1],
        mesh_vertices=points,
        triangles=[[0, 1, 0]],
        width=64,
        height=48,
    )
    assert len(found.weight) == 0


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_every_sample_agrees_with_the_second_rasteriser(seed):
    strands, vertices, triangles = random_scene(seed)
    found = draw(strands, half_width=0.8, vertices=vertices, triangles=triangles)
    points = np.concatenate(strands)
    points = np.c_[points, np.ones(len(points))].astype(np.float32)
    offsets = np.cumsum([0] + [len(strand) for strand in strands])
    nearest = primitive_of_samples(points, offsets, np.full(len(points), 0.8), vertices, triangles, width=64, height=48)
    ids = found.primitive + 1_000_000 * (found.kind == raster.TRIANGLE)
    differing = 0
    for pixel in range(64 * 48):
        here = slice(*found.pixel_offsets[pixel : pixel + 2])
        mine = dict(zip(ids[here], found.weight[here], strict=True))
        names, counts = np.unique(nearest[pixel], return_counts=True)
        theirs = {name: count / 16 for name, count in zip(names, counts, strict=True) if name >= 0}
        differing += sum(abs(mine.get(k, 0) - theirs.get(k, 0)) for k in mine.keys() | theirs.keys()) / 2
    assert differing <= 3 / 16, "more than rounding at an edge"


def test_thin_strands_are_as_faint_as_they_are_thin():
    strands = [[(3 + 0.01 * i, 2 + 0.08 * i, i), (60, 2 + 0.08 * i, i)] for i in range(500)]
    thin, total = 0.2, 0.0
    for strand in strands:
        total += coverage(draw([strand], half_width=thin / 2)).sum()
    whole = coverage(draw([strands[0]], half_width=thin / 2)).sum()
    assert whole <= 57
    found = draw(strands, half_width=thin / 2)
    assert coverage(draw(strands[:1] * 1, half_width=0.0)).sum() == 0
    # One strand draws 3 or 4 of 16 samples; many strands side by side hide 1 - (1 - 0.2)^n of what is behind.
    middle = coverage(found)[10:35, 20:50].mean()
    assert middle == pytest.approx(1 - (1 - 0.2) ** 12.5, abs=0.02)


def test_half_opaque_strands_over_white_are_half_of_each():
    strands = [[(2, 2 + 2 * i, 0), (62, 2 + 2 * i, 0)] for i in range(22)]
    found = draw(strands, half_width=1.0, alpha=0.5)
    assert coverage(found)[1:45, 4:60].mean() == pytest.approx(0.5, abs=0.01)


def test_a_shift_by_whole_pixels_shifts_the_picture():
    strands, vertices, triangles = random_scene(7)
    near = draw(strands, half_width=0.8, alpha=0.6, vertices=vertices, triangles=triangles, size=(160, 160))
    moved = [strand + [37, 61, 0] for strand in strands]
    vertices = vertices + np.float32([37, 61, 0, 0])
    far = draw(moved, half_width=0.8, alpha=0.6, vertices=vertices, triangles=triangles, size=(160, 160))
    assert np.array_equal(coverage(near)[:80, :80], coverage(far)[61:141, 37:117])


def test_a_wider_picture_changes_nothing():
    strands, vertices, triangles = random_scene(8)
    small = draw(strands, vertices=vertices, triangles=triangles, size=(33, 31))
    large = draw(strands, vertices=vertices, triangles=triangles, size=(70, 65))
    assert np.array_equal(coverage(small), coverage(large)[:31, :33])


def test_the_number_of_threads_does_not_matter():
    script = (
        "import numpy as np, hashlib\n"
        "from tress.kernel import raster\n"
        "rng = np.random.default_rng(3)\n"
        "p = np.c_[rng.uniform(0, 200, (3000, 2)), rng.uniform(0, 1, 3000), np.ones(3000)]\n"
        "p = np.repeat(p, 4, axis=0); p[:, :3] += np.cumsum(rng.normal(0, 2, p[:, :3].shape), axis=0) * 0.01\n"
        "f = raster.rasterise(p, offsets=np.arange(0, 12001, 4), half_width_px=np.full(12000, 0.3),"
        " alpha=np.full(12000, 0.7), mesh_vertices=p[:300], triangles=np.arange(300).reshape(-1, 3),"
        " width=200, height=200)\n"
        "print(hashlib.sha256(b''.join(a.tobytes() for a in (f.pixel_offsets, f.kind, f.primitive, f.parameter,"
        " f.weight, f.depth))).hexdigest())\n"
    )
    digests = {
        subprocess.run(
            [sys.executable, "-c", script],
            env={**os.environ, "RAYON_NUM_THREADS": threads},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for threads in ("1", "2", "5")
    }
    assert len(digests) == 1


def test_visible_weight_is_the_strands_share_of_the_picture():
    strands, vertices, triangles = random_scene(9)
    found = draw(strands, vertices=vertices, triangles=triangles)
    points = sum(len(strand) for strand in strands)
    shown = raster.visible_weight(found, points=points)
    of_strands = found.weight[found.kind == raster.SEGMENT].sum()
    assert shown.sum() == pytest.approx(of_strands, rel=1e-5)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"offsets": [0, 3]}, "offsets do not rise"),
        ({"alpha": [1.0]}, "alpha has 1 entries; 2"),
        ({"triangles": [[0, 1, 2]]}, "triangle 0 names"),
        ({"width": 0}, "0 x 8 pixels"),
        ({"width": 20000}, "20000 x 8"),
        ({"strand_points": [[0, 0, 0, 1], [np.nan, 0, 0, 1]]}, "not finite"),
    ],
)
def test_scenes_that_do_not_fit_together_are_refused(change, message):
    scene = {
        "strand_points": [[0, 0, 0, 1], [1, 1, 0, 1]],
        "offsets": [0, 2],
        "half_width_px": [1, 1],
        "alpha": [1.0, 1.0],
        "mesh_vertices": NO_VERTICES,
        "triangles": NO_TRIANGLES,
        "width": 8,
        "height": 8,
    } | change
    with pytest.raises(InputError, match=message):
        raster.rasterise(scene.pop("strand_points"), **scene)
