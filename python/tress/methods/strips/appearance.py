"""What a hairdo of strips looks like: a scene to shade, and pictures from around."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from tress.base.color import srgb_to_linear
from tress.io.strip_glb import CardParams
from tress.kernel.raster import OPAQUE
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.painted_head import SKIN, head_colors
from tress.model.atlas import Atlas
from tress.model.attachment import surface_mesh
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.pointed import pointed
from tress.model.strip import Strip
from tress.model.strip_mesh import strips_mesh
from tress.model.strips import shown_strips
from tress.model.texture import Texture
from tress.render.flat_scene import FlatScene, cutouts_of, flat_scene
from tress.render.gbuffer import rasterise
from tress.render.occlusion import prepared
from tress.render.picture import premultiplied_rgba, srgb_rgb
from tress.render.preview import contact_sheet
from tress.render.style import Style
from tress.render.styles.textured import TexturedStyle
from tress.render.turntable import BACKDROP
from tress.render.views import framed, pivot, turned

Array = np.ndarray[Any, Any]
Color = tuple[float, float, float]

BROWN: Color = (0.085, 0.038, 0.017)
MARGIN = 0.96
"""Of a picture, what a view from above fills at most."""
TONES = 0.16
"""Spread of the strips' brightness."""
PIECES = (3, 4)
"""Of every span along and across: fine enough for smooth light."""
POINTED = 0.35
"""Part of the length over which drawn strips narrow to a point."""
MEET_M = 1e-6
UNTEXTURED = ("gouraud", "toon")
VIEWS = (
    ("front", 0.0, 0.0),
    ("45 degrees", 45.0, 0.0),
    ("left", 90.0, 0.0),
    ("back", 180.0, 0.0),
    ("right", -90.0, 0.0),
    ("above", 0.0, 55.0),
)
TESTED_VIEWS = (("front, alpha test", 0.0), ("back, alpha test", 180.0))
"""As games show the file: every texel of a strip there or not."""


def strips_scene(
    document: Document, *, color: Color = BROWN, time: float = 0.0, textured: bool = True, drawn: bool = False
) -> FlatScene:
    """Head and hair at a time: with the atlas of the strips, or without it in the `color` of the hair.

    `drawn` is hair as drawings have it: all strips of one colour, with pointed tips, and a scalp with a sharp border.
    `for_style` has what suits a style.
    """
    names = shown_strips(document)
    head = surface_mesh(document, HEAD, where="A picture")
    meshes = {HEAD: _two_colored(head, color) if drawn else _colored(head, head_colors(head, color=color))}
    if not names:
        return flat_scene(Scene(meshes=meshes))
    hair = strips_mesh(document, names=names, time=time, pieces=PIECES)
    if drawn:
        meshes["hair"] = _colored(_drawn(hair), _all(hair, color))
        return flat_scene(Scene(meshes=meshes))
    tone = (1 + TONES * (_noise(hair.vertex_attributes["strip"]) - 0.5))[:, None].astype(np.float32)
    if textured and hair.texture is not None:
        meshes["hair"] = _colored(hair, np.repeat(tone, 3, axis=1))
        return flat_scene(Scene(meshes=meshes), maps={"hair": _maps(document, names)})
    meshes["hair"] = _colored(replace(hair, texture=None), tone * np.asarray(color, np.float32))
    return flat_scene(Scene(meshes=meshes))


def for_style(style: Style) -> dict[str, bool]:
    """Options of `strips_scene`: what a style shows of strips."""
    return {"textured": style.name not in UNTEXTURED, "drawn": style.name == "toon"}


def preview(document: Document, *, color: Color = BROWN, style: Style | None = None, height: int = 560) -> Array:
    """(H, W, 3) uint8: the hairdo from five sides and from above, in the style `textured` unless told otherwise.

    Strips with a texture are also shown as a game shows the GLB, by an alpha test, from the front and from behind.
    """
    shown = style or TexturedStyle()
    scene = prepared(strips_scene(document, color=color, **for_style(shown)))
    camera = framed(scene, width=round(0.72 * height), height=height)
    pictures = {
        caption: view(scene, camera, style=shown, azimuth_rad=math.radians(azimuth), elevation_rad=math.radians(up))
        for caption, azimuth, up in VIEWS
    }
    tested = alpha_tested(scene, threshold=CardParams().threshold)
    if tested is not scene:
        for caption, azimuth in TESTED_VIEWS:
            pictures[caption] = view(tested, camera, style=shown, azimuth_rad=math.radians(azimuth))
    return contact_sheet(list(pictures.values()), captions=list(pictures), height=height)


def alpha_tested(scene: FlatScene, *, threshold: float) -> FlatScene:
    """The scene whose textures are opaque where their alpha is `threshold` or more, and let through all elsewhere; the
    scene itself where none has an alpha."""
    if scene.cutouts is OPAQUE:
        return scene
    meshes = tuple(_tested(mesh, threshold) for mesh in scene.meshes)
    return replace(scene, meshes=meshes, cutouts=cutouts_of(meshes))


def _tested(mesh: Mesh, threshold: float) -> Mesh:
    if mesh.texture is None or mesh.texture.pixels.shape[2] != 4:
        return mesh
    pixels = mesh.texture.pixels.copy()
    pixels[..., 3] = np.where(pixels[..., 3] >= 255 * threshold, 255, 0)
    return replace(mesh, texture=Texture(pixels=pixels))


def hair_color(document: Document) -> Color:
    """The mean colour of the hair, linear: that of the first atlas of its strips, or brown."""
    for strip in document.of_type(Strip).values():
        atlas = document.records.get(strip.atlas)
        if isinstance(atlas, Atlas) and atlas.color[..., 3].any():
            alpha = atlas.color[..., 3:] / 255
            red, green, blue = (srgb_to_linear(atlas.color[..., :3]) * alpha).sum(axis=(0, 1)) / alpha.sum()
            return float(red), float(green), float(blue)
    return BROWN


def view(
    scene: FlatScene, camera: Camera, *, style: Style, azimuth_rad: float = 0.0, elevation_rad: float = 0.0
) -> Array:
    """(H, W, 3) uint8: what a camera sees that goes around the head to its left, and above it."""
    place = _seen_from(camera, scene, azimuth_rad, elevation_rad)
    seen = rasterise(scene, xy_from_world=place.xy_from_world, width=place.width, height=place.height)
    return srgb_rgb(premultiplied_rgba(seen, style=style), background=BACKDROP)


def _seen_from(camera: Camera, scene: FlatScene, azimuth_rad: float, elevation_rad: float) -> Camera:
    view = turned(camera, angle_rad=azimuth_rad, pivot_in_world=pivot(scene))
    if not elevation_rad:
        return view
    middle, cos, sin = pivot(scene), math.cos(elevation_rad), math.sin(elevation_rad)
    tilt = np.eye(4)
    tilt[1:3, 1:3] = [[cos, -sin], [sin, cos]]
    tilt[:3, 3] = middle - tilt[:3, :3] @ middle
    return _whole(replace(view, xy_from_world=view.xy_from_world @ tilt), scene)


def _whole(camera: Camera, scene: FlatScene) -> Camera:
    """The camera, moved back and aside where something of the meshes would lie outside its picture."""
    rows, size = camera.xy_from_world[:2], np.array([camera.width, camera.height])
    seen = scene.positions @ rows[:, :3].T + rows[:, 3]
    low, high = seen.min(axis=0), seen.max(axis=0)
    border = 0.5 * (1 - MARGIN) * size
    if (low >= border).all() and (high <= size - border).all():
        return camera
    scale = min(1.0, float((MARGIN * size / (high - low)).min()))
    moved = camera.xy_from_world.copy()
    moved[:2] *= scale
    moved[:2, 3] += size / 2 - scale * (low + high) / 2
    return replace(camera, xy_from_world=moved)


def _maps(document: Document, names: list[str]) -> dict[str, Array]:
    strip = document.records[names[0]]
    atlas = document.records.get(strip.atlas) if isinstance(strip, Strip) else None
    return dict(atlas.maps) if isinstance(atlas, Atlas) else {}


def _colored(mesh: Mesh, color: Array) -> Mesh:
    attributes = {**mesh.vertex_attributes, "color": color.astype(np.float32)}
    return replace(mesh, vertex_attributes=attributes)


def _drawn(hair: Mesh) -> Mesh:
    fraction, strip = hair.vertex_attributes["fraction"], hair.vertex_attributes["strip"]
    positions = pointed(hair.positions, fraction=fraction, strip=strip, share=POINTED)
    positions = np.where(_closed(hair)[:, None], hair.positions, positions)
    return replace(hair, texture=None, positions=positions)


def _two_colored(mesh: Mesh, color: Color) -> Mesh:
    plain = _colored(mesh, _all(mesh, SKIN))
    return replace(plain, vertex_attributes={**plain.vertex_attributes, "scalp_color": _all(mesh, color)})


def _all(mesh: Mesh, color: Any) -> Array:
    return np.broadcast_to(np.asarray(color, np.float32), (len(mesh.positions), 3))


def _closed(mesh: Mesh) -> Array:
    """(V,) bool: the vertices of strips whose first and last points are the same in every row: clumps have tips."""
    side, strip = mesh.vertex_attributes["fraction"][:, 1], mesh.vertex_attributes["strip"]
    left, right = np.flatnonzero(side == 0), np.flatnonzero(side == 1)
    apart = np.abs(mesh.positions[left] - mesh.positions[right]).max(axis=1) > MEET_M
    return np.bincount(strip[left], weights=apart, minlength=int(strip.max()) + 1)[strip] == 0


def _noise(index: Array) -> Array:
    """(N,) float64 in [0, 1), the same for the same index: a golden-ratio sequence."""
    return (index * 0.6180339887498949) % 1.0
