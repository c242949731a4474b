"""USD keeps everything to the bit, says what other programs need, and refuses damaged files."""

import warnings

import numpy as np
import pytest
from documents import documents
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tress.base.errors import ChangedFileWarning, FormatError, InputError, OutputError
from tress.io.formats.usd import open_document, save_document
from tress.io.formats.usd_checks import curve_errors, document_errors
from tress.io.usd import stage
from tress.io.usd.curves import strands_prim
from tress.io.usd.prim import Attribute, Prim
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.strands import Strands
from tress.model.texture import Texture

LAX = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow, HealthCheck.data_too_large]


def portrait(*, shade=0):
    """A small portrait: two strands, a textured head, a camera, a recipe."""
    corner_uv = np.random.default_rng(1).random((2, 3, 2))
    head = Mesh(
        positions=np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]) * 0.1,
        triangles=[[0, 1, 2], [0, 2, 3]],
        corner_uv=corner_uv,
        vertex_attributes={"scalp": np.float32([0, 0.5, 1, 1])},
        texture=Texture(pixels=np.full((4, 8, 3), shade, np.uint8)),
    )
    hair = Strands(
        points=np.random.default_rng(0).random((7, 3)) * 0.1,
        offsets=[0, 3, 7],
        point_attributes={"color": np.full((7, 3), 0.25), "alpha": np.ones(7), "radius": np.full(7, 4e-5)},
        strand_attributes={"root_triangle": [0, -1], "root_barycentric": np.full((2, 3), 1 / 3)},
    )
    camera = Camera(xy_from_world=[[3000, 0, 0, 500], [0, -3000, 0, 400], [0, 0, 0, 1]], width=1000, height=800)
    recipe = Recipe(method="portrait", seed=7, parameters={"trace.step_px": 0.75, "strands": 50_000})
    return Document(
        {"head": Head(mesh=head, shape=[1], expression=[]), "hair": hair, "photo": camera, "recipe": recipe}
    )


@pytest.mark.parametrize("suffix", [".usdc", ".usda", ".usd"])
@settings(max_examples=40, deadline=None, suppress_health_check=LAX)
@given(document=documents())
def test_saving_opening_and_saving_again_loses_nothing(tmp_path, suffix, document):
    path = tmp_path / f"hair{suffix}"
    save_document(document, path)
    first = path.read_bytes()
    opened = open_document(path)
    assert opened == document
    save_document(opened, path)
    assert path.read_bytes() == first


@settings(max_examples=15, deadline=None, suppress_health_check=LAX)
@given(document=documents())
def test_usds_validators_and_ours_find_nothing(tmp_path, document):
    save_document(document, tmp_path / "hair.usdc")
    assert document_errors(tmp_path / "hair.usdc") == []


def test_other_programs_find_what_they_need(tmp_path):
    from pxr import Usd, UsdGeom, UsdShade

    save_document(portrait(), tmp_path / "hair.usdc")
    scene = Usd.Stage.Open(str(tmp_path / "hair.usdc"))
    assert (UsdGeom.GetStageUpAxis(scene), UsdGeom.GetStageMetersPerUnit(scene)) == ("Y", 1.0)
    root = scene.GetDefaultPrim().GetPath()
    curves = UsdGeom.BasisCurves(scene.GetPrimAtPath(root.AppendChild("hair")))
    assert (curves.GetTypeAttr().Get(), curves.GetWrapAttr().Get()) == ("linear", "nonperiodic")
    assert list(curves.GetCurveVertexCountsAttr().Get()) == [3, 4]
    assert (curves.GetWidthsInterpolation(), curves.GetWidthsAttr().Get()[0]) == ("vertex", pytest.approx(8e-5))
    assert curves.GetDisplayColorPrimvar().GetInterpolation() == "vertex"
    assert "GroomAPI" in curves.GetPrim().GetMetadata("apiSchemas").GetAppliedItems()
    root_triangle = UsdGeom.PrimvarsAPI(curves).GetPrimvar("root_triangle")
    assert (root_triangle.GetInterpolation(), list(root_triangle.Get())) == ("uniform", [0, -1])
    mesh = scene.GetPrimAtPath(root.AppendPath("head/mesh"))
    material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    shader, *_ = material.ComputeSurfaceSource()
    picture, *_ = shader.GetInput("diffuseColor").GetConnectedSource()
    file = UsdShade.Shader(picture.GetPrim()).GetInput("file").Get()
    assert file.resolvedPath and file.path.startswith("./textures/")
    assert UsdGeom.Mesh(mesh).GetSubdivisionSchemeAttr().Get() == "none"


def test_the_camera_sees_what_the_photograph_saw(tmp_path):
    from pxr import Gf, Usd, UsdGeom

    document = portrait()
    save_document(document, tmp_path / "hair.usdc")
    scene = Usd.Stage.Open(str(tmp_path / "hair.usdc"))
    camera = UsdGeom.Camera(scene.GetPrimAtPath(scene.GetDefaultPrim().GetPath().AppendChild("photo"))).GetCamera()
    clip_from_world = camera.frustum.ComputeViewMatrix() * camera.frustum.ComputeProjectionMatrix()
    for point in np.random.default_rng(0).uniform(-0.1, 0.1, (5, 3)):
        x, y, _ = clip_from_world.Transform(Gf.Vec3d(*point))
        pixel = [(x + 1) / 2 * 1000, (1 - y) / 2 * 800]
        assert pixel == pytest.approx(document.records["photo"].project(point[None])[0].tolist(), abs=1e-3)


def test_metadata_can_be_read_without_tress(tmp_path):
    from pxr import Usd

    save_document(portrait(), tmp_path / "hair.usda")
    scene = Usd.Stage.Open(str(tmp_path / "hair.usda"))
    prim = scene.GetPrimAtPath("/tress/recipe")
    assert prim.GetCustomData()["tress"]["parameters"] == {"trace.step_px": 0.75, "strands": 50_000}


def test_a_new_texture_replaces_the_old_one_and_spares_other_files(tmp_path):
    save_document(portrait(shade=9), tmp_path / "other.usdc")
    save_document(portrait(shade=1), tmp_path / "hair.usdc")
    save_document(portrait(shade=2), tmp_path / "hair.usdc")
    assert len(list((tmp_path / "textures").iterdir())) == 2
    assert open_document(tmp_path / "hair.usdc") == portrait(shade=2)
    assert open_document(tmp_path / "other.usdc") == portrait(shade=9)


def test_a_crash_while_saving_leaves_the_old_document(tmp_path, monkeypatch):
    path = tmp_path / "hair.usdc"
    save_document(portrait(shade=1), path)

    def interrupted(layer, temporary):
        temporary.write_bytes(b"PXR-USDC half")
        raise KeyboardInterrupt

    monkeypatch.setattr(stage, "_export", interrupted)
    with pytest.raises(KeyboardInterrupt):
        save_document(portrait(shade=2), path)
    assert open_document(path) == portrait(shade=1)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["hair.usdc", "textures"]


def test_what_cannot_be_saved_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"suffix '.txt'; one of .usdc"):
        save_document(portrait(), tmp_path / "hair.txt")
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        save_document(portrait(), tmp_path / "file" / "hair.usdc")


@settings(max_examples=60, deadline=None, suppress_health_check=LAX)
@given(cut=st.floats(0, 1), text=st.booleans())
def test_truncated_files_are_refused(tmp_path, cut, text):
    path = tmp_path / ("hair.usda" if text else "hair.usdc")
    save_document(portrait(), path)
    data = path.read_bytes()
    path.write_bytes(data[: int(cut * (len(data) - 3))])
    with pytest.raises(FormatError):
        open_document(path)


@pytest.mark.slow
def test_hundreds_of_damaged_tables_are_refused_or_read(tmp_path):
    path, random = tmp_path / "hair.usdc", np.random.default_rng(0)
    save_document(portrait(), path)
    whole = path.read_bytes()
    for _ in range(400):
        data = bytearray(whole)
        for place in random.integers(0, len(data), random.integers(1, 6)):
            data[place] ^= 1 << random.integers(0, 8)
        path.write_bytes(data)
        try:
            open_document(path)
        except FormatError as error:
            assert "\n" not in str(error)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('record = "Strands"', 'record = "Wig"', "type 'Wig', which this version does not know"),
        ("int layout = 1", "int layout = 99", "layout 99"),
        ("dictionary tress", "dictionary other", "holds no document of Tress"),
        ("curveVertexCounts = [3, 4]", "curveVertexCounts = [3, 5]", "offsets must run"),
        ("curveVertexCounts = [3, 4]", "curveVertexCounts = [1, 6]", "at least 2"),
        ("curveVertexCounts = [3, 4]", "curveVertexCounts = None", "no points or no vertex counts|array was expected"),
        ('type = "linear"', 'type = "cubic"', "not linear"),
        ("faceVertexCounts = [3, 3]", "faceVertexCounts = [4, 2]", "other faces than triangles"),
        ("faceVertexIndices = [0,", "faceVertexIndices = [9,", "outside 0 to 3"),
        ("@./textures/", "@../textures/", "outside the folder"),
        ("@./textures/", "@./pictures/", "moves with it"),
        ("primvars:scalp = [0,", "primvars:scalp = [nan,", "not finite"),
        ("int64 tress:width = 1000", 'string tress:width = "x"', "int was expected"),
        ("float[] primvars:scalp", "half[] primvars:scalp", "dtype float16"),
        ("int[] curveVertexCounts = [3, 4]", "float[] curveVertexCounts = [3.0, 4.5]", "whole numbers"),
        ("custom int64 tress:height = 800", "", "not hold all fields"),
    ],
)
def test_damaged_documents_are_refused(tmp_path, old, new, message):
    path = tmp_path / "hair.usda"
    save_document(portrait(), path)
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    with pytest.raises(FormatError, match=message):
        open_document(path)


def test_files_of_others_are_refused(tmp_path):
    for name, text in (("a.usda", "#usda 1.0\n"), ("b.usda", "hair"), ("c.usdc", "")):
        (tmp_path / name).write_text(text)
        with pytest.raises(FormatError):
            open_document(tmp_path / name)
    with pytest.raises(FormatError, match="is no file"):
        open_document(tmp_path / "absent.usdc")


def test_our_checks_see_what_usds_do_not():
    prim = strands_prim("hair", portrait().records["hair"])

    def changed(name, value):
        attribute = prim.attributes[name]
        other = Attribute(attribute.type, value, attribute.interpolation)
        return curve_errors(Prim("hair", "BasisCurves", {**prim.attributes, name: other}))

    assert curve_errors(prim) == []
    assert "add up to 8" in changed("curveVertexCounts", np.int32([4, 4]))[0]
    assert "has 1 vertices" in changed("curveVertexCounts", np.int32([1, 6]))[0]
    assert "widths (vertex) has 3 values; 7" in changed("widths", np.zeros(3, np.float32))[0]
    assert "displayColor" in changed("primvars:displayColor", np.zeros((2, 3), np.float32))[0]
    assert "extent is missing" in changed("extent", None)[0]
    assert "outside the extent" in changed("extent", np.zeros((2, 3), np.float32))[0]
    assert "not linear" in changed("type", "cubic")[0]
    assert "missing" in changed("points", None)[0]


def test_fifty_thousand_strands_take_less_than_a_few_seconds(tmp_path):
    count, points = 50_000, 40
    rows = np.zeros((count * points, 3), np.float32)
    hair = Strands(points=rows, offsets=np.arange(count + 1) * points, point_attributes={"color": rows})
    document = Document({"hair": hair})
    from time import perf_counter

    start = perf_counter()
    save_document(document, tmp_path / "hair.usdc")
    assert perf_counter() - start < 5  # 0.5 s on two idle cores; the margin is for busy machines
    assert open_document(tmp_path / "hair.usdc") == document


def test_bits_changed_in_the_middle_are_told(tmp_path):
    path = tmp_path / "hair.usda"
    save_document(portrait(), path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert open_document(path) == portrait()
    text = path.read_text()
    path.write_text(text.replace("int64 tress:width = 1000", "int64 tress:width = 1001"))
    assert path.read_text() != text
    with pytest.warns(ChangedFileWarning, match="was changed after Tress wrote it"):
        assert open_document(path).records["photo"].width == 1001


def test_painted_meshes_have_colours_and_normals_for_other_programs(tmp_path):
    corner = Mesh(
        positions=[[0, 0, 0], [1, 0, 0], [0, 0, -1]],
        triangles=[[0, 1, 2]],
        vertex_attributes={"color": np.float32([[1, 0, 0], [0, 0.5, 0], [0, 0, 0.25]])},
    )
    save_document(Document({"ground": corner}), tmp_path / "a.usda")
    text = (tmp_path / "a.usda").read_text()
    assert "color3f[] primvars:displayColor = [(1, 0, 0), (0, 0.5, 0), (0, 0, 0.25)]" in text
    assert "normal3f[] normals = [(0, 1, 0), (0, 1, 0), (0, 1, 0)]" in text
    assert open_document(tmp_path / "a.usda") == Document({"ground": corner})
    assert document_errors(tmp_path / "a.usda") == []
