"""Drawn hair as GLB: unlit ramp materials and inverted hulls, so that any viewer shows cel shading and outlines.

glTF has no toon material, and viewers shade a lit one smoothly. `KHR_materials_unlit` with a texture shows the colours
as they are; emission on black would too, but glows where a viewer has bloom and depends on its exposure. So the first
texture coordinate of a vertex is the cosine of its normal to a light that is fixed to the head, and the texture is the
ramp: borders of tones are sharp at any distance, since cosines are interpolated and not colours. The second coordinate
leads through the ring of hair, or from skin to scalp. The light follows neither the camera nor hair that moves.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tress import __version__
from tress.base.color import linear_to_srgb8
from tress.base.params import Params, param
from tress.base.tone_ramp import ToneParams, gleaming, tone_ramp
from tress.io.card_levels import card_levels, plain_level
from tress.io.card_mesh import CardMesh
from tress.io.formats.glb import vertex_normals
from tress.io.glb_builder import ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER, TRIANGLES, GlbBuilder
from tress.io.inverted_hull import inverted_hull
from tress.io.png import encode_png
from tress.io.strip_glb import add_clip
from tress.model.document import Document
from tress.model.head import Head
from tress.model.melded_normals import body_normals, melded
from tress.model.pointed import pointed

Array = np.ndarray[Any, Any]
Color = tuple[float, float, float]

UNLIT = "KHR_materials_unlit"
RAMP_PX, ROWS_PX = 512, 512
CLAMP_TO_EDGE, LINEAR = 33071, 9729


@dataclass(frozen=True)
class ToonGlbParams(Params):
    """Light, tones, ring and lines of drawn hair; the light is fixed to the head."""

    azimuth_rad: float = param(0.45, low=-np.pi, high=np.pi, unit="rad", doc="Light to the left of the head's front.")
    elevation_rad: float = param(0.65, low=-1.5, high=1.5, unit="rad", doc="Light above the head.")
    meld: float = param(0.6, low=0, high=1, doc="How far clumps are shaded as one round body of hair.")
    ring: float = param(0.6, low=-1, high=1, doc="Height of the ring: sine of its angle above the head's middle.")
    ring_width: float = param(0.1, low=0, high=1, doc="Width of the ring, as a sine; 0 is none.")
    gleam: float = param(0.42, low=0, high=1, doc="How far the ring goes from the colour to white.")
    outline_m: float = param(0.001, low=0, high=0.1, unit="m", doc="Width of the lines of inverted hulls; 0 is none.")
    ink: float = param(0.18, low=0, high=1, doc="Brightness of lines, as a part of the colour.")
    pointed: float = param(0.35, low=0, high=1, doc="Part of the length over which open strips narrow to a point.")
    tones: ToneParams = field(default_factory=ToneParams)


@dataclass(frozen=True, eq=False)
class Surface:
    """What is drawn: `positions`, `normals` (V, 3), `triangles` (F, 3), `coordinates` (V, 2) in the ramp, `pixels` of
    it, `targets` (M, V, 3) of motion, and the linear `color` of its lines."""

    name: str
    positions: Array
    normals: Array
    triangles: Array
    coordinates: Array
    pixels: Array
    targets: Array
    color: Array


def encode_toon_glb(document: Document, *, color: Color, skin: Color, params: ToonGlbParams | None = None) -> bytes:
    """A file with the head and the strips of a document in flat tones, and with lines about them.

    Strips have the linear `color`, whatever their atlas, the head that of the `skin` and its scalp that of the hair;
    motion becomes a clip. The same document gives the same bytes.
    """
    params = params or ToonGlbParams()
    builder = GlbBuilder(generator=f"Tress {__version__}")
    heads = document.of_type(Head)
    centre = np.zeros(3)  # of the head, in its own frame
    surfaces = [_head(name, head, color, skin, centre, params) for name, head in heads.items()]
    nodes = [node for surface in surfaces for node in _add_surface(builder, surface, params)]
    level = plain_level(document)
    if level is not None:
        made = card_levels(document, [level])
        moving = []
        for number, card in enumerate(made.levels[0].cards):
            moving += _add_surface(builder, _hair(f"hair_{number}", card, color, centre, params), params)
        if made.motion is not None and made.motion.shapes.size:
            add_clip(builder, made.motion, moving, step=made.step)
        nodes += moving
    builder.json |= {"scenes": [{"name": "tress"} | ({"nodes": nodes} if nodes else {})], "scene": 0}
    return builder.encoded()


def _head(name: str, head: Head, color: Color, skin: Color, centre: Array, params: ToonGlbParams) -> Surface:
    mesh = head.mesh
    normals = vertex_normals(mesh)
    cosine = _cosine(mesh.positions, normals, centre, params)
    scalp = mesh.vertex_attributes.get("scalp", np.zeros(len(mesh.positions)))
    skin_row, hair_row = _ramp_rows(np.array([skin, color]), params)
    pixels = np.concatenate([np.repeat(row[None], ROWS_PX // 2, axis=0) for row in (skin_row, hair_row)])
    targets = np.zeros((0, len(mesh.positions), 3), np.float32)
    return Surface(
        name, mesh.positions, normals, mesh.triangles, _coordinates(cosine, scalp), pixels, targets, np.array(skin)
    )


def _hair(name: str, card: CardMesh, color: Color, centre: Array, params: ToonGlbParams) -> Surface:
    positions, targets = card.positions, card.targets
    if params.pointed and not card.closed:
        values = {"fraction": card.fraction, "strip": card.strip, "share": params.pointed}
        positions = pointed(positions, **values)
        targets = np.array([pointed(one, **values) for one in targets], np.float32).reshape(targets.shape)
    body = body_normals(positions, centre=centre)
    inwards = (card.normals * body).sum(axis=1, keepdims=True) < 0
    outer = card.normals if card.closed else np.where(inwards, -card.normals, card.normals)
    cosine = _cosine(positions, outer, centre, params)
    height = 0.5 + 0.5 * (body[:, 1] - params.ring)
    plain, ring = _ramp_rows(np.array([color, color]), params)
    ring = gleaming(ring, gleam=params.gleam)
    place = (np.arange(ROWS_PX) + 0.5) / ROWS_PX
    inside = np.abs(2 * place - 1) < 0.5 * params.ring_width
    pixels = np.where(inside[:, None, None], ring, plain)
    return Surface(
        name,
        positions,
        card.normals,
        card.triangles,
        _coordinates(cosine, height),
        pixels,
        targets,
        np.array(color),
    )


def _light(params: ToonGlbParams) -> Array:
    level = np.array([np.sin(params.azimuth_rad), 0, np.cos(params.azimuth_rad)])
    return np.cos(params.elevation_rad) * level + np.sin(params.elevation_rad) * np.array([0.0, 1.0, 0.0])


def _cosine(positions: Array, normals: Array, centre: Array, params: ToonGlbParams) -> Array:
    body = body_normals(positions, centre=centre)
    return melded(normals.astype(np.float64), body, share=params.meld) @ _light(params)


def _coordinates(cosine: Array, row: Array) -> Array:
    return np.clip(np.stack([0.5 + 0.5 * cosine, row], axis=1), 0, 1).astype(np.float32)


def _ramp_rows(colors: Array, params: ToonGlbParams) -> list[Array]:
    """The ramp of every colour, (RAMP_PX, 3) linear, from the cosine -1 to 1."""
    cosine = 2 * (np.arange(RAMP_PX) + 0.5) / RAMP_PX - 1
    ramp = tone_ramp(params.tones)
    return [ramp.of(color, cosine) for color in colors]


def _add_surface(builder: GlbBuilder, surface: Surface, params: ToonGlbParams) -> list[int]:
    """The nodes of a surface: itself, and its lines."""
    texture = _add_texture(builder, surface)
    material = _add_material(builder, surface.name, {"baseColorTexture": {"index": texture}}, both_sides=True)
    nodes = [
        _add_node(
            builder,
            surface.name,
            {"POSITION": surface.positions, "TEXCOORD_0": surface.coordinates},
            surface.triangles,
            targets=surface.targets,
            material=material,
        )
    ]
    if params.outline_m > 0 and len(surface.triangles):
        hull = inverted_hull(
            surface.positions, normals=surface.normals, triangles=surface.triangles, width_m=params.outline_m
        )
        ink = [*(params.ink * surface.color).tolist(), 1.0]
        lines = _add_material(builder, f"{surface.name}_lines", {"baseColorFactor": ink}, both_sides=False)
        nodes.append(
            _add_node(
                builder,
                f"{surface.name}_lines",
                {"POSITION": surface.positions[hull.vertex] + hull.shift},
                hull.triangles,
                targets=surface.targets[:, hull.vertex],
                material=lines,
            )
        )
    return nodes


def _add_node(
    builder: GlbBuilder, name: str, attributes: dict[str, Array], triangles: Array, *, targets: Array, material: int
) -> int:
    primitive: dict[str, Any] = {
        "attributes": {
            key: builder.add_accessor(np.ascontiguousarray(values, np.float32), target=ARRAY_BUFFER)
            for key, values in attributes.items()
        },
        "indices": builder.add_accessor(triangles.reshape(-1).astype(np.uint32), target=ELEMENT_ARRAY_BUFFER),
        "material": material,
        "mode": TRIANGLES,
    }
    mesh: dict[str, Any] = {"name": name, "primitives": [primitive]}
    if len(targets):
        primitive["targets"] = [
            {"POSITION": builder.add_accessor(np.ascontiguousarray(one), target=ARRAY_BUFFER)} for one in targets
        ]
        mesh["weights"] = [0.0] * len(targets)
    return builder.add("nodes", {"name": name, "mesh": builder.add("meshes", mesh)})


def _add_material(builder: GlbBuilder, name: str, surface: dict[str, Any], *, both_sides: bool) -> int:
    builder.add_extension(UNLIT)
    rough = {"metallicFactor": 0.0, "roughnessFactor": 1.0} | surface
    material = {"name": name, "pbrMetallicRoughness": rough, "extensions": {UNLIT: {}}}
    return builder.add("materials", material | ({"doubleSided": True} if both_sides else {}))


def _add_texture(builder: GlbBuilder, surface: Surface) -> int:
    image = builder.add_png(encode_png(linear_to_srgb8(surface.pixels)), name=f"{surface.name}_ramp")
    # No smaller copies of the ramp: they would mix the tones of the whole hair from afar.
    sampler = {"magFilter": LINEAR, "minFilter": LINEAR, "wrapS": CLAMP_TO_EDGE, "wrapT": CLAMP_TO_EDGE}
    return builder.add("textures", {"source": image, "sampler": builder.add("samplers", sampler)})
