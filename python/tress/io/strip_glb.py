"""Strips as GLB: a mesh for every level and atlas, `MSFT_lod` between levels, motion as a clip of morph targets.

Morph targets and not joints: where strips are at a time is linear in their keyframes, so that a few targets hold any
motion of a hairdo exactly (see `principal_motion`), whatever the number of strips and control points. Joints along the
strips would take thousands for a hairdo, more than engines allow a mesh, and could not twist a strip.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress import __version__
from tress.base.params import Params, choice, param
from tress.io.card_mesh import CardMesh
from tress.io.glb_builder import ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER, TRIANGLES, GlbBuilder
from tress.io.png import encode_png
from tress.model.atlas import Atlas
from tress.model.principal_motion import PrincipalMotion

Array = np.ndarray[Any, Any]

LOD, ANISOTROPY = "MSFT_lod", "KHR_materials_anisotropy"
CLIP = "motion"
GREY = (0.5, 0.42, 0.36, 1.0)
REPEAT_NOT, LINEAR, LINEAR_MIPMAP_LINEAR = 33071, 9729, 9987
SHORT_INDICES = 65535


@dataclass(frozen=True)
class CardParams(Params):
    """How viewers treat the transparency of strips."""

    alpha: str = choice(
        "mask", options=("mask", "blend"), doc="An alpha test (no sorting), or blending (soft, sorting errors)."
    )
    threshold: float = param(0.5, low=0.01, high=0.99, doc="Alpha test: less is not drawn.")


@dataclass(frozen=True, eq=False)
class CardLevel:
    """One level: its meshes, and the atlases by name that they are covered with, in the resolution of the level.

    `coverage` is the share of the picture's height that the hair takes where the next level takes over, 0 for the last.
    """

    cards: tuple[CardMesh, ...]
    atlases: Mapping[str, Atlas]
    coverage: float = 0.0


def add_levels(
    builder: GlbBuilder,
    levels: Sequence[CardLevel],
    *,
    name: str,
    motion: PrincipalMotion | None = None,
    step: bool = False,
    params: CardParams | None = None,
) -> int:
    """Adds the levels to a file and returns the node to put into the scene, that of the first level.

    The others hang on it by `MSFT_lod`, with `MSFT_screencoverage` in its extras. `motion` becomes one clip that moves
    all levels; with `step` it jumps. Level k is named `name_lod{k}`.
    """
    params = params or CardParams()
    nodes, moving = [], []
    for number, level in enumerate(levels):
        node, meshes = _add_level(builder, level, name=f"{name}_lod{number}", params=params)
        nodes.append(node)
        moving += meshes
    if len(nodes) > 1:
        builder.add_extension(LOD)
        builder.json["nodes"][nodes[0]] |= {
            "extensions": {LOD: {"ids": nodes[1:]}},
            "extras": {"MSFT_screencoverage": [level.coverage for level in levels]},
        }
    if motion is not None and motion.shapes.size and moving:
        add_clip(builder, motion, moving, step=step)
    return nodes[0]


def encode_levels(
    levels: Sequence[CardLevel],
    *,
    name: str = "hair",
    motion: PrincipalMotion | None = None,
    step: bool = False,
    params: CardParams | None = None,
) -> bytes:
    """A file with nothing but the levels; the same levels give the same bytes."""
    builder = GlbBuilder(generator=f"Tress {__version__}")
    node = add_levels(builder, levels, name=name, motion=motion, step=step, params=params)
    builder.json |= {"scenes": [{"name": "tress", "nodes": [node]}], "scene": 0}
    return builder.encoded()


def _add_level(builder: GlbBuilder, level: CardLevel, *, name: str, params: CardParams) -> tuple[int, list[int]]:
    """The node of a level and those of its meshes: itself where there is one."""
    single = len(level.cards) == 1
    made = [
        _add_card(
            builder, card, level.atlases.get(card.atlas), name if single else f"{name}_{card.atlas or 'plain'}", params
        )
        for card in level.cards
    ]
    return (made[0] if single else builder.add("nodes", {"name": name, "children": made})), made


def _add_card(builder: GlbBuilder, card: CardMesh, atlas: Atlas | None, name: str, params: CardParams) -> int:
    attributes = {
        "POSITION": builder.add_accessor(card.positions, target=ARRAY_BUFFER),
        "NORMAL": builder.add_accessor(card.normals, target=ARRAY_BUFFER),
        "TANGENT": builder.add_accessor(card.tangents, target=ARRAY_BUFFER),
        "TEXCOORD_0": builder.add_accessor(
            card.uv * np.array([1, -1], np.float32) + np.array([0, 1], np.float32), target=ARRAY_BUFFER
        ),
    }
    short = len(card.positions) <= SHORT_INDICES
    indices = card.triangles.reshape(-1).astype(np.uint16 if short else np.uint32)
    primitive: dict[str, Any] = {
        "attributes": attributes,
        "indices": builder.add_accessor(indices, target=ELEMENT_ARRAY_BUFFER),
        "material": _add_material(builder, atlas, name, params),
        "mode": TRIANGLES,
    }
    mesh: dict[str, Any] = {"name": name, "primitives": [primitive]}
    if len(card.targets):
        primitive["targets"] = [{"POSITION": builder.add_accessor(one, target=ARRAY_BUFFER)} for one in card.targets]
        mesh["weights"] = [0.0] * len(card.targets)
    return builder.add("nodes", {"name": name, "mesh": builder.add("meshes", mesh)})


def _add_material(builder: GlbBuilder, atlas: Atlas | None, name: str, params: CardParams) -> int:
    surface: dict[str, Any] = {"metallicFactor": 0.0, "roughnessFactor": 0.55}
    material: dict[str, Any] = {"name": name, "doubleSided": True, "pbrMetallicRoughness": surface}
    if atlas is None:
        surface["baseColorFactor"] = GREY
        return builder.add("materials", material)
    surface["baseColorTexture"] = {"index": _add_texture(builder, atlas.color, f"{name}_color")}
    material |= {"alphaMode": "BLEND"} if params.alpha == "blend" else _mask(params)
    normal = atlas.maps.get("normal")
    if normal is not None and normal.dtype == np.uint8 and normal.shape[2:] == (3,):
        material["normalTexture"] = {"index": _add_texture(builder, normal, f"{name}_normal")}
    builder.add_extension(ANISOTROPY)
    # Highlights are long across the strands: a strip's hair runs along the bitangent.
    material["extensions"] = {ANISOTROPY: {"anisotropyStrength": 0.6, "anisotropyRotation": np.pi / 2}}
    return builder.add("materials", material)


def _mask(params: CardParams) -> dict[str, Any]:
    return {"alphaMode": "MASK", "alphaCutoff": params.threshold}


def _add_texture(builder: GlbBuilder, pixels: Array, name: str) -> int:
    image = builder.add_png(encode_png(pixels), name=name)
    sampler = {
        "magFilter": LINEAR,
        "minFilter": LINEAR_MIPMAP_LINEAR,
        "wrapS": REPEAT_NOT,
        "wrapT": REPEAT_NOT,
    }
    return builder.add("textures", {"source": image, "sampler": builder.add("samplers", sampler)})


def add_clip(builder: GlbBuilder, motion: PrincipalMotion, nodes: Sequence[int], *, step: bool) -> None:
    """Adds one clip that moves the morph targets of all `nodes`; with `step` it jumps."""
    times = (motion.times - min(motion.times[0], 0.0)).astype(np.float32)
    sampler = {
        "input": builder.add_accessor(times, target=None, limits=True),
        "output": builder.add_accessor(motion.weights.astype(np.float32).reshape(-1), target=None),
        "interpolation": "STEP" if step else "LINEAR",
    }
    channels = [{"sampler": 0, "target": {"node": node, "path": "weights"}} for node in nodes]
    builder.add("animations", {"name": CLIP, "samplers": [sampler], "channels": channels})
