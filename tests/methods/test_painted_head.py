"""Heads in their colours: the same in pictures and in files."""

from dataclasses import replace

import numpy as np
import pytest
from ball_hair import ball_hair
from glb_reader import parsed

from tress.io.formats.glb import write_glb
from tress.methods.strips.appearance import alpha_tested, hair_color, preview, strips_scene
from tress.methods.strips.painted_head import SKIN, painted
from tress.model.document import Document
from tress.model.texture import Texture
from tress.render.styles.gouraud import GouraudStyle

RED = (0.4, 0.02, 0.01)
HAIR = ball_hair(24)
PAINTED = painted(HAIR, color=RED)


def test_skin_where_no_hair_grows_and_the_colour_of_hair_where_it_does():
    mesh = PAINTED.records["head"].mesh
    scalp, color = mesh.vertex_attributes["scalp"], mesh.vertex_attributes["color"]
    assert np.allclose(color[scalp == 0], SKIN) and color.dtype == np.float32
    assert np.allclose(color[scalp == 1], 0.1 * np.array(SKIN) + 0.9 * 0.6 * np.array(RED))


def test_a_head_with_a_picture_keeps_it():
    head = HAIR.records["head"]
    uv = np.zeros((len(head.mesh.triangles), 3, 2), np.float32)
    photo = replace(head.mesh, corner_uv=uv, texture=Texture(pixels=np.zeros((2, 2, 3), np.uint8)))
    document = Document({**HAIR.records, "head": replace(head, mesh=photo)})
    assert painted(document, color=RED) == document


def test_the_glb_has_the_colours_and_normals_of_the_preview(tmp_path):
    write_glb(PAINTED, tmp_path / "a.glb")
    data = (tmp_path / "a.glb").read_bytes()
    document, arrays, _ = parsed(data)
    mesh = next(mesh for mesh in document["meshes"] if mesh["name"] == "head")
    (part,) = mesh["primitives"]
    color = arrays[part["attributes"]["COLOR_0"]][:, :3] / 65535
    positions = arrays[part["attributes"]["POSITION"]]
    own = PAINTED.records["head"].mesh
    assert np.array_equal(positions, own.positions)  # every vertex of the ball is used
    assert np.abs(color - own.vertex_attributes["color"]).max() < 1e-4
    shown = strips_scene(PAINTED).meshes[1].vertex_attributes["color"]
    assert np.array_equal(shown, own.vertex_attributes["color"])
    assert (np.sum(arrays[part["attributes"]["NORMAL"]] * positions, axis=1) > 0.09).all()
    material = document["materials"][part["material"]]
    assert material["pbrMetallicRoughness"]["baseColorFactor"] == [1, 1, 1, 1]


def test_the_alpha_test_keeps_the_area_of_strands():
    scene = strips_scene(HAIR)
    tested = alpha_tested(scene, threshold=0.5)
    soft, hard = (np.mean(one.meshes[0].texture.pixels[..., 3] / 255) for one in (scene, tested))
    assert set(np.unique(tested.meshes[0].texture.pixels[..., 3])) == {0, 255}
    assert hard == pytest.approx(soft, rel=0.15)
    plain = strips_scene(HAIR, textured=False)
    assert alpha_tested(plain, threshold=0.5) is plain


def test_the_preview_shows_what_passes_the_test_too():
    wide = preview(HAIR, height=60).shape[1]
    assert wide > 1.25 * preview(HAIR, height=60, style=GouraudStyle()).shape[1]


def test_the_colour_of_hair_is_that_of_its_atlas():
    atlas = HAIR.records["atlas"]
    seen = atlas.color[..., :3][atlas.color[..., 3] == 255] / 255
    assert np.abs(np.array(hair_color(HAIR)) ** (1 / 2.2) - seen.mean(axis=0)).max() < 0.06
    bald = Document({"head": HAIR.records["head"]})
    assert hair_color(bald) == (0.085, 0.038, 0.017)
