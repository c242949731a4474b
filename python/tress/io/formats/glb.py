"""Scenes as GLB (glTF 2.0, binary), for viewers, engines and Blender.

Meshes keep their picture, or their vertex colours; strands become thin ribbons (or lines) with their colours. The
pictures of a reconstruction hold the light of the photograph already, so materials with one are unlit by default, and
viewers show the colours as they are; the others are lit, and have normals.
Viewers that do not know KHR_materials_unlit fall back on a rough dielectric. glTF knows no strands, so nothing is
read back.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tress import __version__
from tress.base.params import Params, choice
from tress.io.atomic import write_bytes
from tress.io.card_levels import CardLevels, card_levels, plain_level
from tress.io.format import Format
from tress.io.glb_builder import ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER, LINES, TRIANGLES, GlbBuilder
from tress.io.mesh_normals import vertex_colors, vertex_normals
from tress.io.png import encode_png
from tress.io.ribbons import RibbonParams, ribbons, thinned
from tress.io.strip_glb import CardParams, add_levels
from tress.model.document import Document
from tress.model.evaluate import Scene
from tress.model.group import Group
from tress.model.mesh import Mesh
from tress.model.strands import Strands
from tress.model.strip import Strip

Array = np.ndarray[Any, Any]

UNLIT = "KHR_materials_unlit"
GREY, WHITE = (0.6, 0.6, 0.6, 1.0), (1.0, 1.0, 1.0, 1.0)
CLAMP_TO_EDGE, LINEAR, LINEAR_MIPMAP_LINEAR = 33071, 9729, 9987


@dataclass(frozen=True)
class GlbParams(Params):
    """How strands and light appear."""

    hair: str = choice("ribbons", options=("ribbons", "lines"), doc="Thin ribbons, or lines of one pixel.")
    light: str = choice("unlit", options=("unlit", "lit"), doc="Colours as they are, or lit by the viewer.")
    ribbons: RibbonParams = field(default_factory=RibbonParams)
    cards: CardParams = field(default_factory=CardParams)


def encode_glb(scene: Scene, *, params: GlbParams | None = None, strips: CardLevels | None = None) -> bytes:
    """The file's bytes, one node for each of the strands and meshes; the same scene gives the same bytes.

    `strips` are levels of detail of strips, which move, beside the scene.
    """
    params = params or GlbParams()
    builder = GlbBuilder(generator=f"Tress {__version__}")
    nodes = [_add_mesh(builder, name, mesh, params) for name, mesh in scene.meshes.items() if len(mesh.triangles)]
    nodes += [_add_hair(builder, name, hair, params) for name, hair in scene.strands.items() if hair.count]
    if strips is not None:
        nodes.append(
            add_levels(
                builder, strips.levels, name="strips", motion=strips.motion, step=strips.step, params=params.cards
            )
        )
    root: dict[str, Any] = {"name": "tress"} | ({"nodes": nodes} if nodes else {})
    builder.json |= {"scenes": [root], "scene": 0}
    return builder.encoded()


def write_glb(document: Document, path: Path) -> None:
    """Writes all strands, meshes and strips of a document with the default `GlbParams`; strips with their motion."""
    level = plain_level(document)
    strips = None if level is None else card_levels(document, [level])
    write_bytes(path, encode_glb(scene_beside_strips(document), strips=strips))


def scene_beside_strips(document: Document) -> Scene:
    """What there is to see of a document without its strips and groups."""
    others = {name: item for name, item in document.records.items() if not isinstance(item, Strip | Group)}
    found = {name: record.evaluated(document, 0.0, name=name) for name, record in others.items()}
    return Scene(
        strands={name: seen for name, seen in found.items() if isinstance(seen, Strands)},
        meshes={name: seen for name, seen in found.items() if isinstance(seen, Mesh)},
    )


FORMAT = Format("glb", (".glb",), write_glb)


def _add_hair(builder: GlbBuilder, name: str, strands: Strands, params: GlbParams) -> int:
    if params.hair == "lines":
        return _add_lines(builder, name, strands, params)
    found = ribbons(strands, params=params.ribbons)
    attributes = {"POSITION": builder.add_accessor(found.positions, target=ARRAY_BUFFER)}
    if params.light == "lit":
        attributes["NORMAL"] = builder.add_accessor(found.normals, target=ARRAY_BUFFER)
    attributes["COLOR_0"] = _add_color(builder, found.color)
    material = _add_material(builder, name, params.light, {"doubleSided": True})
    return _add_node(builder, name, attributes, found.triangles.reshape(-1), material=material, mode=TRIANGLES)


def _add_lines(builder: GlbBuilder, name: str, strands: Strands, params: GlbParams) -> int:
    settings = params.ribbons
    shown = thinned(strands, strands_at_most=settings.strands, points_at_most=settings.points, seed=settings.seed)
    inner = np.ones(len(shown.points), bool)
    inner[shown.offsets[1:] - 1] = False
    first = np.flatnonzero(inner).astype(np.uint32)
    attributes = {"POSITION": builder.add_accessor(shown.points, target=ARRAY_BUFFER)}
    if (color := shown.point_attributes.get("color")) is not None:
        attributes["COLOR_0"] = _add_color(builder, color)
    material = _add_material(builder, name, "unlit", {})
    return _add_node(
        builder, name, attributes, np.stack([first, first + 1], 1).reshape(-1), material=material, mode=LINES
    )


def _add_mesh(builder: GlbBuilder, name: str, mesh: Mesh, params: GlbParams) -> int:
    vertex, corner_uv, indices = _split_corners(mesh)
    attributes = {"POSITION": builder.add_accessor(mesh.positions[vertex], target=ARRAY_BUFFER)}
    light = params.light if mesh.texture is not None else "lit"
    if light == "lit":
        attributes["NORMAL"] = builder.add_accessor(vertex_normals(mesh)[vertex], target=ARRAY_BUFFER)
    painted = vertex_colors(mesh)
    if painted is not None:
        attributes["COLOR_0"] = _add_color(builder, painted[vertex])
    material: dict[str, Any] = {"pbrMetallicRoughness": {"baseColorFactor": GREY if painted is None else WHITE}}
    if mesh.texture is not None and corner_uv is not None:
        attributes["TEXCOORD_0"] = builder.add_accessor(corner_uv, target=ARRAY_BUFFER)
        material = {"pbrMetallicRoughness": {"baseColorTexture": {"index": _add_texture(builder, name, mesh)}}}
    number = _add_material(builder, name, light, material)
    return _add_node(builder, name, attributes, indices, material=number, mode=TRIANGLES)


def _split_corners(mesh: Mesh) -> tuple[Array, Array | None, Array]:
    """Vertices split where the texture is cut: the old vertex and the coordinates of each new one, and new indices.

    glTF counts v from the top.
    """
    corners = mesh.triangles.reshape(-1)
    if mesh.corner_uv is None:
        used, indices = np.unique(corners, return_inverse=True)
        return used, None, indices.astype(np.uint32)
    uv = mesh.corner_uv.reshape(-1, 2) * np.array([1, -1], np.float32) + np.array([0, 1], np.float32)
    bits = np.ascontiguousarray(uv).view(np.int32).astype(np.int64)
    _, first, indices = np.unique(np.column_stack([corners, bits]), axis=0, return_index=True, return_inverse=True)
    return corners[first], uv[first], indices.reshape(-1).astype(np.uint32)


def _add_texture(builder: GlbBuilder, name: str, mesh: Mesh) -> int:
    assert mesh.texture is not None
    image = builder.add_png(encode_png(mesh.texture.pixels), name=name)
    sampler = {"magFilter": LINEAR, "minFilter": LINEAR_MIPMAP_LINEAR, "wrapS": CLAMP_TO_EDGE, "wrapT": CLAMP_TO_EDGE}
    return builder.add("textures", {"source": image, "sampler": builder.add("samplers", sampler)})


def _add_color(builder: GlbBuilder, color: Array) -> int:
    """Linear RGB as 16 bits: 8 would show steps in dark hair. The fourth number makes rows of whole 4 bytes."""
    rgba = np.full((len(color), 4), 65535, np.uint16)
    rgba[:, :3] = np.clip(color, 0, 1) * 65535 + 0.5
    return builder.add_accessor(rgba, target=ARRAY_BUFFER, normalized=True)


def _add_material(builder: GlbBuilder, name: str, light: str, more: dict[str, Any]) -> int:
    surface = {"metallicFactor": 0.0, "roughnessFactor": 0.8} | more.get("pbrMetallicRoughness", {})
    material = {"name": name} | more | {"pbrMetallicRoughness": surface}
    if light == "unlit":
        builder.add_extension(UNLIT)
        material["extensions"] = {UNLIT: {}}
    return builder.add("materials", material)


def _add_node(
    builder: GlbBuilder, name: str, attributes: Mapping[str, int], indices: Array, *, material: int, mode: int
) -> int:
    primitive = {
        "attributes": dict(attributes),
        "indices": builder.add_accessor(indices, target=ELEMENT_ARRAY_BUFFER),
        "material": material,
        "mode": mode,
    }
    return builder.add(
        "nodes", {"name": name, "mesh": builder.add("meshes", {"name": name, "primitives": [primitive]})}
    )
