"""Triangles of patches: on the surface, as near as promised, without cracks, slivers or folds."""

import os
import subprocess
import sys
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kernel.splines import random_patch
from kernel.surfaces import cylinder, plane, sphere

from tress.base.errors import InputError
from tress.kernel import geom, nurbs
from tress.kernel.nurbs import Patches, patch
from tress.kernel.tessellation import segments_for, tessellate, tessellate_segments, tessellate_spans

SEEDS = st.integers(0, 2**32 - 1)


def strip(*, width=0.02, tip=0.0):
    """A bent strip of 8 x 4 control points, 0.2 m long, whose tip has the share `tip` of its width."""
    along = np.linspace(0, 1, 8)
    across = np.linspace(-0.5, 0.5, 4)
    taper = np.where(np.arange(8) == 7, tip, 1.0)
    x = 0.05 * np.sin(3 * along)[:, None] + width * taper[:, None] * across
    y = np.broadcast_to(-0.2 * along[:, None], x.shape)
    z = np.broadcast_to(0.04 * along[:, None] ** 2, x.shape) + 0.3 * width * taper[:, None] * across**2
    return patch(np.stack([x, y, z], axis=-1))


def far_from(mesh, made, count=60):
    """Greatest distance of a grid of points of the patch from the mesh."""
    fractions = np.linspace(0, 1, count)
    queries = nurbs.evaluate_grid(made, u=fractions, v=fractions).reshape(-1, 3)
    return geom.closest_points(mesh.positions, triangles=mesh.triangles, queries=queries).distance.max()


def welded_edges(mesh):
    """How often each edge between two places occurs, in either direction."""
    _, place = np.unique(mesh.positions, axis=0, return_inverse=True)
    corners = place.reshape(-1)[mesh.triangles]
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    return Counter(map(tuple, edges.tolist()))


def test_one_bicubic_strip_gives_the_papers_three_levels():
    for polygons, segments in ((88, (11, 8)), (35, (7, 5)), (12, (4, 3))):
        mesh = tessellate_segments(strip(tip=0.3), segments=segments)
        assert mesh.polygons.tolist() == [polygons]
        assert len(mesh.triangles) == 2 * polygons
        chosen = segments_for(strip(tip=0.3), polygons=polygons)
        assert polygons / 2 < chosen.prod() <= polygons


@given(seed=SEEDS, m=st.integers(1, 12), n=st.integers(1, 9))
def test_corners_are_the_points_of_direct_evaluation(seed, m, n):
    made = random_patch(seed)
    mesh = tessellate_segments(made, segments=(m, n))
    expected = nurbs.evaluate_grid(made, u=np.arange(m + 1) / m, v=np.arange(n + 1) / n)
    assert np.allclose(mesh.positions, expected.reshape(-1, 3), rtol=0, atol=1e-12)
    assert np.allclose(mesh.positions, nurbs.evaluate(made, uv=mesh.uv), rtol=0, atol=1e-12)
    assert np.array_equal(mesh.normals, nurbs.normals(made, uv=mesh.uv))


@given(seed=SEEDS)
def test_spans_are_divided_at_their_knots(seed):
    made = random_patch(seed)
    mesh = tessellate_spans(made, per_span=(2, 1))
    for column, (knots, domain, parts) in enumerate(
        ((made.knots_u, made.domain_u, 2), (made.knots_v, made.domain_v, 1))
    ):
        breaks = np.unique(knots[(knots >= domain[0]) & (knots <= domain[1])])
        lines = np.unique(mesh.uv[:, column])
        assert len(lines) == parts * (len(breaks) - 1) + 1 == mesh.segments[0, column] + 1
        assert set(breaks) <= set(lines)


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3])
@pytest.mark.parametrize("made", [sphere(), cylinder(), strip(), strip(tip=1.0), random_patch(3, degrees=(2, 1))])
def test_the_surface_is_as_near_as_promised(made, accuracy):
    mesh = tessellate(made, accuracy=accuracy)
    assert mesh.error[0] <= accuracy
    assert far_from(mesh, made) <= mesh.error[0] * (1 + 1e-9)


def test_a_cylinder_takes_about_as_many_chords_as_its_sagitta_asks():
    for accuracy in (1e-2, 1e-3, 1e-4):
        needed = np.pi / np.arccos(1 - accuracy)
        around, upwards = tessellate(cylinder(), accuracy=accuracy).segments[0]
        assert upwards == 1
        assert needed <= around <= 2.5 * needed


def test_flat_patches_need_one_cell():
    assert tessellate(plane(), accuracy=1e-9).segments.tolist() == [[1, 1]]
    assert segments_for(plane(), polygons=50).tolist() == [[1, 1]]


def test_creases_are_kept():
    ridge = patch([[[x, y, abs(x)] for y in (0.0, 1.0)] for x in (-1.0, 0.0, 1.0)], degree_u=1, degree_v=1)
    mesh = tessellate(ridge, accuracy=10.0)
    assert mesh.segments.tolist() == [[2, 1]]
    assert far_from(mesh, ridge) < 1e-15


@pytest.mark.parametrize("made", [sphere(), strip(), strip(tip=1.0), strip().reversed_u(), strip().transposed()])
def test_there_is_no_crack_no_sliver_and_no_fold(made):
    mesh = tessellate(made, accuracy=2e-4)
    corners = mesh.positions[mesh.triangles]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert (areas > 1e-4 * sides.max(axis=1) ** 2).all()
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("fk,fck->fc", faces, mesh.normals[mesh.triangles]) > 0).all()
    often = welded_edges(mesh)
    assert set(often.values()) <= {1, 2}
    rim = [edge for edge, count in often.items() if count == 1]
    ends = Counter(place for edge in rim for place in edge)
    assert all(count == 2 for count in ends.values())
    assert len(np.unique(mesh.triangles)) == len(mesh.positions)


def test_a_collapsed_tip_is_one_place_with_one_triangle_a_cell():
    mesh = tessellate_segments(strip(), segments=(5, 3))
    assert len(mesh.triangles) == 2 * 4 * 3 + 3
    tips = mesh.uv[:, 0] == 1
    assert np.allclose(mesh.uv[tips, 1], [1 / 6, 1 / 2, 5 / 6])
    assert len(np.unique(mesh.positions[tips], axis=0)) == 1
    assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1)
    both = patch(np.stack([strip().points[0] * 0, *strip().points[1:]]))
    assert len(tessellate_segments(both, segments=(5, 3)).triangles) == 2 * 3 * 3 + 6
    nothing = patch(np.zeros((4, 4, 3)))
    assert len(tessellate_segments(nothing, segments=(5, 3)).triangles) == 0


def test_accuracy_in_pixels_is_accuracy_in_the_picture():
    scale = 800.0
    orthographic = np.array([[scale, 0, 0, 100], [0, -scale, 0, 100], [0, 0, 0, 1.0]])
    made = strip(tip=1.0)
    seen = tessellate(made, accuracy=0.25, projection=orthographic)
    flat = patch(made.points * [1, 1, 0])
    assert seen.segments.tolist() == tessellate(flat, accuracy=0.25 / scale).segments.tolist()
    far = np.array([[scale, 0, 0, 0], [0, scale, 0, 0], [0, 0, 1.0, 5.0]])
    near = far + [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, -4.5]]
    counts = [tessellate(made, accuracy=0.25, projection=p).polygons[0] for p in (far, near)]
    assert counts[0] < counts[1]
    with pytest.raises(InputError, match="behind the camera"):
        tessellate(made, accuracy=0.25, projection=far + [[0] * 4, [0] * 4, [0, 0, 0, -6.0]])


@given(seed=SEEDS, polygons=st.integers(1, 60))
def test_budgets_are_kept(seed, polygons):
    made = random_patch(seed)
    segments = segments_for(made, polygons=polygons)
    assert 1 <= segments.prod() <= polygons


def test_more_polygons_follow_the_patch_more_closely():
    made = strip(tip=0.5)
    errors = [
        far_from(tessellate_segments(made, segments=segments_for(made, polygons=n)), made) for n in (2, 12, 35, 88, 300)
    ]
    assert errors == sorted(errors, reverse=True)
    naive = far_from(tessellate_segments(made, segments=(5, 7)), made)
    assert errors[2] < naive


def test_a_batch_is_its_patches_one_by_one():
    patches = [random_patch(seed, degrees=(3, 3)) for seed in range(12)] + [strip()]
    many = tessellate(Patches.of(patches), accuracy=0.01)
    for i, made in enumerate(patches):
        alone = tessellate(made, accuracy=0.01)
        corners = slice(*many.corner_offsets[i : i + 2])
        triangles = many.triangles[slice(*many.triangle_offsets[i : i + 2])]
        assert np.array_equal(many.positions[corners], alone.positions)
        assert np.array_equal(triangles - many.corner_offsets[i], alone.triangles)
        assert many.error[i] == alone.error[0]
    assert np.array_equal(many.corner_patch[many.corner_offsets[:-1]], np.arange(13))
    each = np.arange(1, 14)[:, None] * [1, 2]
    assert tessellate_segments(Patches.of(patches), segments=each).segments.tolist() == each.tolist()
    assert len(tessellate(Patches.of([]), accuracy=1.0).positions) == 0


def test_one_thread_gives_the_same_bits():
    code = (
        "import sys; sys.path.insert(0, 'tests')\n"
        "from hashlib import sha256\nfrom kernel.splines import random_patch\n"
        "from tress.kernel.nurbs import Patches\nfrom tress.kernel.tessellation import tessellate\n"
        "mesh = tessellate(Patches.of([random_patch(s) for s in range(20)]), accuracy=0.02)\n"
        "print(sha256(b''.join(a.tobytes() for a in vars(mesh).values())).hexdigest())\n"
    )
    found = {
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=env).stdout
        for env in ({**os.environ, "RAYON_NUM_THREADS": n} for n in ("1", "5"))
    }
    assert len(found) == 1


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: tessellate(plane(), accuracy=0), "accuracy is 0; a positive number"),
        (lambda: tessellate(plane(), accuracy=float("nan")), "accuracy is nan"),
        (lambda: tessellate(plane(), accuracy=1, projection=np.eye(4)), "projection has shape"),
        (lambda: tessellate_segments(plane(), segments=(0, 3)), "segments runs from 0 to 3"),
        (lambda: tessellate_segments(plane(), segments=[(1, 3)] * 2), "segments has shape"),
        (lambda: tessellate_spans(plane(), per_span=(1.5, 2)), "whole numbers were expected"),
        (lambda: segments_for(plane(), polygons=0), "polygons is 0; at least 1 a patch was expected"),
    ],
)
def test_wrong_settings_are_refused(call, message):
    with pytest.raises(InputError, match=message):
        call()
