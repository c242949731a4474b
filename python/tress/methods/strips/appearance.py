"""What a hairdo of strips looks like: a scene to shade, and pictures from around."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from tress.methods.strips.bald_document import HEAD
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
from tress.render.flat_scene import FlatScene, flat_scene
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
SKIN: Color = (0.50, 0.29, 0.20)
SHADED = 0.9
"""How far the scalp has the colour of the hair: roots that no strip stands for."""
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


def strips_scene(
    document: Document, *, color: Color = BROWN, time: float = 0.0, textured: bool = True, drawn: bool = False
) -> FlatScene:
    """Head and hair at a time: with the atlas of the strips, or without it in the `color` of the hair.

    `drawn` is hair as drawings have it: all strips of one colour, with pointed tips, and a scalp with a sharp border.
    `for_style` has what suits a style.
    """
    names = shown_strips(document)
    head = surface_mesh(document, HEAD, where="A picture")
    meshes = {HEAD: _two_colored(head, color) if drawn else _colored(head, _skin(head, color))}
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
    """(H, W, 3) uint8: the hairdo from five sides and from above, in the style `textured` unless told otherwise."""
    shown = style or TexturedStyle()
    scene = prepared(strips_scene(document, color=color, **for_style(shown)))
    camera = framed(scene, width=round(0.72 * height), height=height)
    pictures = [
        view(scene, camera, style=shown, azimuth_rad=math.radians(azimuth), elevation_rad=math.radians(elevation))
        for _, azimuth, elevation in VIEWS
    ]
    return contact_sheet(pictures, captions=[name for name, *_ in VIEWS], height=height)


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
    return Camera(xy_from_world=view.xy_from_world @ tilt, width=view.width, height=view.height)


def _maps(document: Document, names: list[str]) -> dict[str, Array]:
    strip = document.records[names[0]]
    atlas = document.records.get(strip.atlas) if isinstance(strip, Strip) else None
    return dict(atlas.maps) if isinstance(atlas, Atlas) else {}


def _colored(mesh: Mesh, color: Array) -> Mesh:
    attributes = {**mesh.vertex_attributes, "color": color.astype(np.float32)}
    return replace(mesh, vertex_attributes=attributes)


def _skin(mesh: Mesh, color: Color) -> Array:
    scalp = SHADED * mesh.vertex_attributes["scalp"][:, None]
    return np.array(SKIN) * (1 - scalp) + scalp * 0.6 * np.asarray(color)


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
