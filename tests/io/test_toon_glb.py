"""Drawn hair as GLB: valid, unlit, tones by the light, hulls that stick out by the width of the line."""

import numpy as np
import pytest
from ball_hair import ball_hair
from browser import shown_by_three
from glb_reader import parsed
from gltf_validator import validator_report

from tress.base.color import linear_to_srgb8
from tress.base.tone_ramp import ToneParams, tone_ramp
from tress.io.inverted_hull import inverted_hull
from tress.io.toon_glb import ToonGlbParams, encode_toon_glb
from tress.model.mesh import Mesh
from tress.model.pointed import pointed
from tress.model.strip_grid import grid_triangles
from tress.render.mesh_frames import vertex_normals

HAIR = ball_hair(12, moving=True)
COLORS = {"color": (0.1, 0.05, 0.02), "skin": (0.5, 0.3, 0.2)}


@pytest.mark.parametrize("outline", [0.0, 0.001])
def test_the_validator_finds_nothing(tmp_path, outline):
    data = encode_toon_glb(HAIR, **COLORS, params=ToonGlbParams(outline_m=outline))
    (tmp_path / "a.glb").write_bytes(data)
    report = validator_report(tmp_path / "a.glb")
    assert report["issues"]["messages"] == []
    assert report["info"]["animationCount"] == 1 and report["info"]["drawCallCount"] == (4 if outline else 2)
    assert data == encode_toon_glb(HAIR, **COLORS, params=ToonGlbParams(outline_m=outline))


def test_all_is_unlit_and_only_surfaces_have_two_sides():
    document, *_ = parsed(encode_toon_glb(HAIR, **COLORS))
    materials = {item["name"]: item for item in document["materials"]}
    assert set(materials) == {"head", "head_lines", "hair_0", "hair_0_lines"}
    assert all("KHR_materials_unlit" in item["extensions"] for item in materials.values())
    assert all(item.get("doubleSided", False) != name.endswith("_lines") for name, item in materials.items())


def sheet(size=0.1, count=5):
    x, y = np.meshgrid(np.linspace(-size, size, count), np.linspace(-size, size, count))
    positions = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    return Mesh(positions=positions, triangles=grid_triangles(count, count))


def test_the_hull_of_a_strip_is_a_shell_on_either_side_that_grows_by_the_width():
    mesh = sheet()
    normals = vertex_normals(mesh)
    hull = inverted_hull(mesh.positions, normals=normals, triangles=mesh.triangles, width_m=0.01)
    shell = Mesh(positions=mesh.positions[hull.vertex] + hull.shift, triangles=hull.triangles)
    assert np.abs(shell.positions[:, :2]).max(axis=0) == pytest.approx(0.1 + 0.01 / np.sqrt(2), abs=0.0031)
    middle = np.abs(shell.positions[:, 1]) < 0.06
    assert np.abs(shell.positions[middle, 0]).max() == pytest.approx(0.11, abs=1e-6)
    assert np.unique(np.abs(shell.positions[:, 2]).round(6)) == pytest.approx([0.01])
    # Each shell lies on one side and looks to the other.
    inner = np.abs(shell.positions[:, :2]).max(axis=1) < 0.06
    looks = vertex_normals(shell)[inner, 2] * shell.positions[inner, 2]
    assert (looks < 0).all()


def test_the_hull_of_a_closed_body_is_one_shell_inside_out():
    down, round_ = np.meshgrid(np.linspace(0, np.pi, 13), np.linspace(0, 2 * np.pi, 25), indexing="ij")
    place = np.stack([np.sin(down) * np.sin(round_), np.cos(down), np.sin(down) * np.cos(round_)], axis=-1).reshape(
        -1, 3
    )
    faces = grid_triangles(13, 25)
    first, second = (place[faces[:, k]] - place[faces[:, 0]] for k in (1, 2))
    area = np.cross(first, second)
    kept = np.linalg.norm(area, axis=1) > 1e-9
    outwards = (area * place[faces].mean(axis=1)).sum(axis=1) > 0
    faces = np.where(outwards[:, None], faces, faces[:, ::-1])[kept]
    hull = inverted_hull(0.1 * place, normals=place, triangles=faces, width_m=0.01)
    grown = 0.1 * place[hull.vertex] + hull.shift
    np.testing.assert_allclose(np.linalg.norm(grown, axis=1), 0.11, atol=1e-6)
    corners = grown[hull.triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert len(hull.triangles) == kept.sum() and ((area * corners.mean(axis=1)).sum(axis=1) < 0).all()


def test_points_narrow_to_the_middle_and_keep_the_root():
    t, s = np.meshgrid(np.linspace(0, 1, 21), np.linspace(0, 1, 5), indexing="ij")
    values = np.stack([s.ravel() - 0.5, -t.ravel(), np.zeros(t.size)], axis=1)
    fraction = np.stack([t.ravel(), s.ravel()], axis=1)
    found = pointed(values, fraction=fraction, strip=np.zeros(t.size, np.int32), share=0.5).reshape(21, 5, 3)
    wide = found[:, -1, 0] - found[:, 0, 0]
    np.testing.assert_allclose(wide[:11], 1, atol=1e-6)
    left = np.linspace(1, 0, 11)[1:-1]
    np.testing.assert_allclose(wide[11:-1], np.sqrt(left * (2 - left)), atol=1e-5)
    assert wide[-1] == pytest.approx(0.02, abs=1e-6)
    np.testing.assert_allclose(found[..., 1], -t, atol=1e-6)


def test_tones_are_those_of_the_light_fixed_to_the_head():
    params = ToonGlbParams(azimuth_rad=0.0, elevation_rad=0.0, meld=1.0, outline_m=0.0)
    document, arrays, _ = parsed(encode_toon_glb(HAIR, **COLORS, params=params))
    head = next(item for item in document["meshes"] if item["name"] == "head")["primitives"][0]["attributes"]
    positions, coordinates = (arrays[head[key]] for key in ("POSITION", "TEXCOORD_0"))
    outwards = positions.copy()
    outwards[:, 1] = np.maximum(outwards[:, 1], 0)
    cosine = outwards[:, 2] / np.linalg.norm(outwards, axis=1).clip(1e-9)
    np.testing.assert_allclose(coordinates[:, 0], 0.5 + 0.5 * cosine, atol=1e-4)


def test_three_js_shows_the_tones_as_they_are(tmp_path):
    """Whatever its lights: nearly all pixels of hair have one of the tones that Tress draws, or the ink of lines."""
    params = ToonGlbParams(ring_width=0.0)
    (tmp_path / "a.glb").write_bytes(encode_toon_glb(HAIR, **COLORS, params=params))
    shown = shown_by_three(tmp_path / "a.glb", tmp_path)
    assert shown.errors == [] and {"hair_0", "hair_0_lines", "head_lines"} <= set(shown.meshes)
    color = np.array(COLORS["color"])
    tones = tone_ramp(ToneParams()).of(color, np.array([-1.0, 1.0]))
    inks = params.ink * np.array([color, COLORS["skin"]])
    allowed = linear_to_srgb8(np.concatenate([tones, inks]).astype(np.float32)).astype(int)
    picture = shown.pictures[0][..., :3].astype(int)
    hair = picture[shown.hair(0) > 0.999]
    off = np.abs(hair[:, None] - allowed[None]).max(axis=2).min(axis=1)
    near = [(np.abs(hair - one).max(axis=1) <= 3).mean() for one in allowed]
    assert (off <= 3).mean() > 0.8 and near[0] > 0.02 and near[1] > 0.02 and near[2] > 0.005
