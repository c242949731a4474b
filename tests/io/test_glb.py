"""GLB: the Khronos validator finds nothing, colours and texture coordinates are those of the scene."""

import numpy as np
import pytest
from documents import documents
from glb_reader import parsed
from gltf_validator import validator_report
from hypothesis import HealthCheck, given, settings

from tress.base.errors import ParameterError
from tress.io.formats.glb import GlbParams, encode_glb
from tress.io.mesh_normals import vertex_normals
from tress.io.png import decode_png
from tress.io.ribbons import RibbonParams, ribbons, thinned
from tress.model.evaluate import Scene, evaluate
from tress.model.mesh import Mesh
from tress.model.strands import Strands
from tress.model.texture import Texture


def wig(count=40, points=9):
    """Strands that hang from a ring, with all standard attributes."""
    angle = np.repeat(np.linspace(0, 6, count), points)
    fall = np.tile(np.linspace(0, 0.2, points), count)
    total = count * points
    return Strands(
        points=np.column_stack([0.1 * np.cos(angle), 0.1 - fall, 0.1 * np.sin(angle)]),
        offsets=np.arange(count + 1) * points,
        point_attributes={
            "color": np.tile([0.5, 0.25, 0.125], (total, 1)),
            "alpha": np.tile(np.linspace(1, 0.5, points), count),
            "radius": np.full(total, 4e-5),
        },
    )


def textured():
    """A square of two triangles whose corners show the corners of a picture."""
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    pixels = np.arange(4 * 8 * 3, dtype=np.uint8).reshape(4, 8, 3)
    return Mesh(
        positions=np.column_stack([uv, np.zeros(4)]),
        triangles=triangles,
        corner_uv=uv[triangles],
        texture=Texture(pixels=pixels),
    )


SCENE = Scene(strands={"hair": wig()}, meshes={"head": textured()})


@pytest.mark.parametrize("hair", ["ribbons", "lines"])
@pytest.mark.parametrize("light", ["unlit", "lit"])
def test_the_validator_finds_nothing(tmp_path, hair, light):
    (tmp_path / "a.glb").write_bytes(encode_glb(SCENE, params=GlbParams(hair=hair, light=light)))
    report = validator_report(tmp_path / "a.glb")
    assert report["issues"]["messages"] == []
    assert report["info"]["drawCallCount"] == 2


@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
@given(documents())
def test_the_validator_finds_no_error_in_any_scene(tmp_path, document):
    (tmp_path / "a.glb").write_bytes(encode_glb(evaluate(document)))
    issues = validator_report(tmp_path / "a.glb")["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_a_scene_without_anything_is_a_file(tmp_path):
    (tmp_path / "a.glb").write_bytes(encode_glb(Scene()))
    assert validator_report(tmp_path / "a.glb")["issues"]["numErrors"] == 0


def test_the_picture_lies_on_the_mesh_as_in_the_scene():
    document, arrays, views = parsed(encode_glb(SCENE))
    attributes = document["meshes"][0]["primitives"][0]["attributes"]
    positions, uv = arrays[attributes["POSITION"]], arrays[attributes["TEXCOORD_0"]]
    assert np.array_equal(uv, np.column_stack([positions[:, 0], 1 - positions[:, 1]]))  # v from the top
    pixels = decode_png(views[document["images"][0]["bufferView"]], name="head")
    assert np.array_equal(pixels, SCENE.meshes["head"].texture.pixels)


def test_vertices_are_split_only_where_the_texture_is_cut():
    mesh = textured()
    whole = encode_glb(Scene(meshes={"head": mesh}))
    uv = mesh.corner_uv.copy()
    uv[1] *= 0.5
    cut = Mesh(positions=mesh.positions, triangles=mesh.triangles, corner_uv=uv, texture=mesh.texture)
    counts = [parsed(data)[0]["accessors"][0]["count"] for data in (whole, encode_glb(Scene(meshes={"head": cut})))]
    assert counts == [4, 5]  # of the two shared corners, (0, 0) stays where it was


@pytest.mark.parametrize("hair", ["ribbons", "lines"])
def test_colours_are_linear(hair):
    document, arrays, _ = parsed(encode_glb(Scene(strands={"hair": wig()}), params=GlbParams(hair=hair)))
    color = arrays[document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"]] / 65535
    assert np.abs(color - [0.5, 0.25, 0.125, 1]).max() < 1e-5


def test_lines_join_neighbours_of_one_strand():
    document, arrays, _ = parsed(encode_glb(Scene(strands={"hair": wig(3, 4)}), params=GlbParams(hair="lines")))
    indices = arrays[document["meshes"][0]["primitives"][0]["indices"]]
    assert indices.reshape(-1, 2).tolist() == [[s * 4 + k, s * 4 + k + 1] for s in range(3) for k in range(3)]


def test_ribbons_lie_about_their_strands():
    hair = wig()
    found = ribbons(hair, params=RibbonParams(points=9))
    left, right = found.positions[0::2], found.positions[1::2]
    assert np.allclose((left + right) / 2, hair.points, atol=1e-7)
    width = np.linalg.norm(right - left, axis=1)
    assert np.allclose(width, 2 * 4e-5 * 1.3 * hair.point_attributes["alpha"], rtol=1e-3)
    across = (right - left)[1:-1]
    along = (hair.points[2:] - hair.points[:-2])[:, None, :]
    inside = np.ones(len(hair.points), bool)
    inside[hair.offsets[:-1]] = inside[hair.offsets[1:] - 1] = False
    assert np.abs(np.einsum("nk,nlk->n", across, along))[inside[1:-1]].max() < 1e-8
    assert len(found.triangles) == 2 * (len(hair.points) - hair.count)


def test_flat_ribbons_face_away_from_the_head():
    hair = wig()
    found = ribbons(hair, params=RibbonParams(roll=0.0))
    outward = found.positions * [1, 0, 1]
    assert (np.einsum("nk,nk->n", found.normals, outward) > 0.099).all()


def test_a_subset_covers_what_all_covered():
    hair = wig(count=400)
    whole = ribbons(hair, params=RibbonParams(points=9, max_width_m=1))
    some = ribbons(hair, params=RibbonParams(points=9, max_width_m=1, strands=100))

    def area(found):
        a, b, c = (found.positions[found.triangles[:, corner]].astype(float) for corner in range(3))
        return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2

    assert len(some.positions) * 4 == len(whole.positions)
    assert area(some) == pytest.approx(area(whole), rel=0.01)


def test_thinning_keeps_ends_and_straight_lines():
    hair = wig(count=50, points=33)
    found = thinned(hair, strands_at_most=20, points_at_most=5, seed=3)
    assert (found.count, set(found.lengths.tolist())) == (20, {5})
    assert np.allclose(found.points[0::5, 1], 0.1) and np.allclose(found.points[4::5, 1], -0.1)
    assert np.allclose(found.points[2::5, 1], 0.0, atol=1e-7)
    assert thinned(hair, strands_at_most=20, points_at_most=5, seed=3) == found
    assert thinned(hair, strands_at_most=20, points_at_most=5, seed=4) != found
    assert thinned(hair, strands_at_most=99, points_at_most=99, seed=0).points.tobytes() == hair.points.tobytes()


def test_fifty_thousand_strands_stay_below_25_megabytes():
    assert len(encode_glb(Scene(strands={"hair": wig(50_000, 40)}))) < 25e6


def test_normals_of_a_sphere_point_outwards():
    from scipy.spatial import ConvexHull

    points = np.random.default_rng(0).normal(size=(400, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    triangles = ConvexHull(points).simplices
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    inward = np.einsum("nk,nk->n", np.cross(b - a, c - a), a) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    normals = vertex_normals(Mesh(positions=points, triangles=triangles))
    assert np.einsum("nk,nk->n", normals, points).min() > 0.95


def test_wrong_settings_are_refused():
    with pytest.raises(ParameterError, match="one of ribbons, lines"):
        GlbParams(hair="cards")
