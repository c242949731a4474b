"""Strips as USD: what other programs find, and what is found in files of other programs."""

import numpy as np
import pytest
from foreign_patch import foreign
from pxr import Usd, UsdGeom, UsdShade

from tress.base.errors import FormatError
from tress.io.formats.usd import open_document, save_document
from tress.io.formats.usd_checks import document_errors
from tress.kernel.curves import uniform_knots
from tress.model.atlas import Atlas
from tress.model.attachment import Attachment
from tress.model.document import Document
from tress.model.group import Group
from tress.model.keyframes import Keyframes
from tress.model.mesh import Mesh
from tress.model.strip import Strip
from tress.model.strip_mesh import strips_mesh
from tress.model.strip_set import posed_points, strip_set

RANDOM = np.random.default_rng(8)
GROUND = Mesh(positions=[[0, 0, 0], [0, 0, 1], [1, 0, 0]], triangles=[[0, 1, 2]])
ROOT = Attachment(surface="ground", triangle=0, barycentric=[0.5, 0.25, 0.25], offset=[0, 0, 0.01])


def strip(**changes):
    net = {"points": RANDOM.normal(size=(5, 4, 3)), "weights": RANDOM.uniform(0.5, 2, (5, 4))}
    return Strip(**net | {"knots_u": uniform_knots(5, degree=3), "knots_v": uniform_knots(4, degree=2)} | changes)


def hairdo():
    atlas = Atlas(
        color=RANDOM.integers(0, 256, (4, 4, 4), np.uint8),
        regions=[[0, 0, 1, 1]],
        maps={"normal": RANDOM.integers(0, 256, (4, 4, 3), np.uint8), "depth": RANDOM.random((4, 4), np.float32)},
    )
    return Document(
        {
            "ground": GROUND,
            "atlas": atlas,
            "tuft": Group(),
            "a": strip(root=ROOT, group="tuft", atlas="atlas"),
            "b": strip(group="tuft", atlas="atlas"),
            "c": strip(hidden=True),
            "wind": Keyframes(target="tuft", times=[0, 0.5, 1], values=RANDOM.normal(size=(3, 1, 1, 3)), frame="head"),
        }
    )


def saved(tmp_path, document):
    save_document(document, tmp_path / "hair.usda")
    assert open_document(tmp_path / "hair.usda") == document
    assert document_errors(tmp_path / "hair.usda") == []
    return Usd.Stage.Open(str(tmp_path / "hair.usda"))


def test_a_patch_is_a_guide_in_the_head_frame_and_moves(tmp_path):
    document = hairdo()
    scene = saved(tmp_path, document)
    patch = UsdGeom.NurbsPatch(scene.GetPrimAtPath("/tress/a/patch"))
    a = document.records["a"]
    assert (patch.GetUVertexCountAttr().Get(), patch.GetVVertexCountAttr().Get()) == (5, 4)
    assert (patch.GetUOrderAttr().Get(), patch.GetVOrderAttr().Get()) == (4, 3)
    assert list(patch.GetUKnotsAttr().Get()) == a.knots_u.tolist()
    assert patch.ComputePurpose() == "guide"
    weights = np.array(patch.GetPointWeightsAttr().Get()).reshape(4, 5).T
    assert np.array_equal(weights, a.weights)
    assert (scene.GetStartTimeCode(), scene.GetEndTimeCode(), scene.GetTimeCodesPerSecond()) == (0, 24, 24)
    times = patch.GetPointsAttr().GetTimeSamples()
    assert len(times) == 25
    for code in times[::5]:
        points = np.array(patch.GetPointsAttr().Get(code)).reshape(4, 5, 3).transpose(1, 0, 2)
        wanted = posed_points(strip_set(document, ["a"]), code / 24).reshape(5, 4, 3)
        assert points == pytest.approx(wanted, abs=1e-6)


def test_beside_the_patches_lies_one_textured_mesh_of_the_group(tmp_path):
    document = hairdo()
    scene = saved(tmp_path, document)
    meshes = [prim.GetPath().pathString for prim in scene.Traverse() if prim.GetTypeName() == "Mesh"]
    assert meshes == ["/tress/ground", "/tress/tuft/mesh"]
    mesh = UsdGeom.Mesh(scene.GetPrimAtPath("/tress/tuft/mesh"))
    assert (mesh.ComputePurpose(), mesh.GetDoubleSidedAttr().Get()) == ("default", True)
    wanted = strips_mesh(document, names=["a", "b"], time=0.5)
    assert np.array_equal(np.array(mesh.GetPointsAttr().Get(12)), wanted.positions)
    material, _ = UsdShade.MaterialBindingAPI(mesh.GetPrim()).ComputeBoundMaterial()
    shader, *_ = material.ComputeSurfaceSource()
    assert shader.GetInput("opacity").GetConnectedSource()[1] == "a"
    hidden = UsdGeom.NurbsPatch(scene.GetPrimAtPath("/tress/c/patch"))
    assert hidden.ComputeVisibility() == "invisible"


def test_pictures_of_an_atlas_lie_beside_the_file(tmp_path):
    saved(tmp_path, hairdo())
    assert len(list((tmp_path / "textures").iterdir())) == 2


def test_patches_of_others_open_as_strips_in_metres_and_y_up(tmp_path):
    net = foreign(tmp_path / "maya.usda")
    document = open_document(tmp_path / "maya.usda")
    strip = document.records["lock"]
    assert strip.degrees == (3, 2)
    assert np.array_equal(strip.weights, np.ones((4, 3)))
    x, y, z = np.moveaxis(net, -1, 0)
    assert strip.points == pytest.approx(0.01 * np.stack([x, z + 10, -y], axis=-1), abs=1e-9)
    assert list(document.records) == ["lock"]


def test_time_samples_of_others_become_keyframes(tmp_path):
    foreign(tmp_path / "maya.usdc", samples=True, up="Y", metres=1.0)
    document = open_document(tmp_path / "maya.usdc")
    motion = document.records["lock_keyframes"]
    assert motion.times.tolist() == [0, 0.5, 1]
    assert (motion.kind, motion.interpolation) == ("position", "linear")
    posed = posed_points(strip_set(document, ["lock"]), 0.25).reshape(4, 3, 3)
    assert posed - document.records["lock"].points == pytest.approx(np.full((4, 3, 3), [0, 0, 7.5]), abs=1e-5)
    save_document(document, tmp_path / "own.usdc")
    assert open_document(tmp_path / "own.usdc") == document


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"uKnots": [0, 0, 0, 0, 1, 1, 1]}, "7 uKnots for 4 points of order 4; 8"),
        ({"uKnots": [0, 0, 0, 0, 1, 1, 0.5, 1]}, "decreases"),
        ({"uKnots": None}, "uKnots"),
        ({"uVertexCount": 5}, "12 points or weights for 5 x 3"),
        ({"uOrder": None}, "no uOrder"),
        ({"points": None}, "has no points"),
        ({"points": np.full((12, 3), np.nan, np.float32)}, "not finite"),
        ({"pointWeights": [0.0] * 12}, "above 0"),
        ({"pointWeights": [1.0] * 11}, "11 points or weights"),
    ],
)
def test_broken_patches_of_others_are_refused(tmp_path, changes, message):
    foreign(tmp_path / "maya.usda", **changes)
    with pytest.raises(FormatError, match=message):
        open_document(tmp_path / "maya.usda")
