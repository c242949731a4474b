"""Strips as GLB: levels, atlases, transparency and motion, as a reader sees them that knows nothing of the writer."""

from dataclasses import replace

import numpy as np
import pytest
from ball_hair import ball_hair, sway
from glb_reader import parsed
from gltf_validator import validator_report

from tress.base.errors import ParameterError
from tress.io.card_levels import card_levels, clip_times, plain_level
from tress.io.card_mesh import card_mesh
from tress.io.formats.glb import write_glb
from tress.io.strip_glb import CardParams, encode_levels
from tress.model.diff import Diff, apply
from tress.model.document import Document
from tress.model.keyframes import Keyframes
from tress.model.level import Level, level_surface
from tress.model.principal_motion import principal_motion
from tress.model.strip_set import posed_points, resting_points, strip_set

HAIR = ball_hair(12, moving=True)
PLAIN = plain_level(HAIR)
HALF = Level(names=PLAIN.names[::2], segments=np.full((6, 2), (5, 1)), widening=np.full(6, 1.5))


def levels(document=HAIR):
    return card_levels(document, [PLAIN, HALF], coverage=(0.4, 0.1))


def encoded(document=HAIR, **params):
    made = levels(document)
    return encode_levels(made.levels, motion=made.motion, step=made.step, params=CardParams(**params))


def with_motion(*motions):
    return Document({**ball_hair(12).records, **{f"m{k}": motion for k, motion in enumerate(motions)}})


@pytest.mark.parametrize("alpha", ["mask", "blend"])
def test_the_validator_finds_nothing_in_one_level(tmp_path, alpha):
    made = levels()
    data = encode_levels(made.levels[:1], motion=made.motion, params=CardParams(alpha=alpha))
    (tmp_path / "a.glb").write_bytes(data)
    report = validator_report(tmp_path / "a.glb")
    assert report["issues"]["messages"] == []
    assert (report["info"]["drawCallCount"], report["info"]["animationCount"]) == (1, 1)


def test_the_validator_knows_all_but_levels(tmp_path):
    (tmp_path / "a.glb").write_bytes(encoded())
    assert {issue["code"] for issue in validator_report(tmp_path / "a.glb")["issues"]["messages"]} == {
        "UNSUPPORTED_EXTENSION"
    }


def test_levels_hang_on_the_first():
    document, _, _ = parsed(encoded())
    (root,) = document["scenes"][0]["nodes"]
    node = document["nodes"][root]
    (lower,) = node["extensions"]["MSFT_lod"]["ids"]
    assert (node["name"], document["nodes"][lower]["name"]) == ("hair_lod0", "hair_lod1")
    assert node["extras"]["MSFT_screencoverage"] == [0.4, 0.1]
    assert "MSFT_lod" in document["extensionsUsed"] and "extensionsRequired" not in document


@pytest.mark.parametrize(("alpha", "mode"), [("mask", "MASK"), ("blend", "BLEND")])
def test_transparency_is_as_asked(alpha, mode):
    document, _, _ = parsed(encoded(alpha=alpha, threshold=0.4))
    for material in document["materials"]:
        assert material["alphaMode"] == mode and material["doubleSided"]
        assert material.get("alphaCutoff") == (0.4 if alpha == "mask" else None)
        assert {"normalTexture"} <= set(material)


def test_the_clip_moves_the_vertices_as_the_keyframes_do():
    document, arrays, _ = parsed(encoded())
    (animation,) = document["animations"]
    sampler = animation["samplers"][0]
    times, weights = arrays[sampler["input"]][:, 0], arrays[sampler["output"]]
    weights = weights.reshape(len(times), -1)
    for node, level in zip((0, 1), (PLAIN, HALF), strict=True):
        primitive = document["meshes"][document["nodes"][node]["mesh"]]["primitives"][0]
        rest = arrays[primitive["attributes"]["POSITION"]]
        targets = np.stack([arrays[target["POSITION"]] for target in primitive["targets"]])
        assert len(targets) == 2
        surface = level_surface(HAIR, level)
        for frame in (0, len(times) // 3, len(times) - 1):
            shown = rest + np.tensordot(weights[frame], targets, axes=1)
            wanted = surface.grid.points(posed_points(surface.strips, float(times[frame])))
            assert np.abs(shown - wanted).max() < 2e-4 * 1.5
    assert {channel["target"]["path"] for channel in animation["channels"]} == {"weights"}


def test_linear_and_stepped_motions_keep_their_moments():
    for kind, step in (("linear", False), ("step", True)):
        times, steps = clip_times(with_motion(sway(interpolation=kind)), PLAIN.names)
        assert times == [0, 0.5, 1, 1.5, 2] and steps == step
    mixed, steps = clip_times(with_motion(sway(interpolation="step"), sway()), PLAIN.names)
    assert len(mixed) > 40 and not steps
    assert clip_times(ball_hair(12), PLAIN.names) == ([], False)
    document, _, _ = parsed(encoded(with_motion(sway(interpolation="step"))))
    assert document["animations"][0]["samplers"][0]["interpolation"] == "STEP"


def test_hair_without_motion_has_no_clip_and_no_targets():
    document, _, _ = parsed(encoded(ball_hair(12)))
    assert "animations" not in document and "targets" not in document["meshes"][0]["primitives"][0]


def test_a_few_displacements_hold_any_motion():
    rng = np.random.default_rng(0)
    own = [
        Keyframes(target=name, times=[0, 1, 2], values=rng.normal(0, 0.01, (3, 8, 4, 3))) for name in PLAIN.names[:5]
    ]
    strips = strip_set(with_motion(sway(), *own), PLAIN.names)
    times = np.linspace(0, 2, 41).tolist()
    found = principal_motion(strips, times=times, accuracy=1e-5)
    assert len(found.shapes) <= 5 and found.error_m <= 1e-5
    for time, weights in zip(times, found.weights, strict=True):
        moved = resting_points(strips) + np.tensordot(weights, found.shapes, axes=1)
        assert np.linalg.norm(moved - posed_points(strips, time), axis=1).max() <= found.error_m + 1e-12
    assert np.abs(found.weights).max() == 1


def test_each_atlas_has_a_mesh_of_its_own(tmp_path):
    strip = HAIR.records["s0000"]
    changes = {"s0000": (strip, replace(strip, atlas="second", group=""))}
    document = apply(Diff(added={"second": HAIR.records["atlas"]}, updated=changes), HAIR)
    data = encoded(document)
    meshes = [mesh["name"] for mesh in parsed(data)[0]["meshes"]]
    assert meshes == ["hair_lod0_atlas", "hair_lod0_second", "hair_lod1_atlas", "hair_lod1_second"]
    (tmp_path / "a.glb").write_bytes(data)
    assert validator_report(tmp_path / "a.glb")["issues"]["numErrors"] == 0


def test_tangents_run_across_the_strip_and_bitangents_to_the_root():
    card = card_mesh(HAIR, level_surface(HAIR, PLAIN), atlas="atlas")
    a, b, c = (card.positions[card.triangles[:, k]].astype(float) for k in range(3))
    (ua, va), (ub, vb), (uc, vc) = (card.uv[card.triangles[:, k]].astype(float).T for k in range(3))
    det = (ub - ua) * (vc - va) - (uc - ua) * (vb - va)
    along_u = ((b - a) * (vc - va)[:, None] - (c - a) * (vb - va)[:, None]) / det[:, None]
    along_v = ((c - a) * (ub - ua)[:, None] - (b - a) * (uc - ua)[:, None]) / det[:, None]
    tangent, normal = card.tangents[card.triangles[:, 0]], card.normals[card.triangles[:, 0]]
    assert np.median((tangent[:, :3] * along_u).sum(1) / np.linalg.norm(along_u, axis=1)) > 0.99
    bitangent = np.cross(normal, tangent[:, :3]) * tangent[:, 3:]
    assert np.median((bitangent * along_v).sum(1) / np.linalg.norm(along_v, axis=1)) > 0.99


def test_a_document_is_written_with_its_motion(tmp_path):
    write_glb(HAIR, tmp_path / "a.glb")
    document, _, _ = parsed((tmp_path / "a.glb").read_bytes())
    assert [node["name"] for node in document["nodes"]] == ["head", "strips_lod0"]
    assert document["animations"][0]["name"] == "motion"
    assert validator_report(tmp_path / "a.glb")["issues"]["messages"] == []


def test_wrong_settings_are_refused():
    with pytest.raises(ParameterError, match="one of mask, blend"):
        CardParams(alpha="dither")
