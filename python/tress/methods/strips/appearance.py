"""What a hairdo of strips looks like: colours at the vertices (Gouraud), and pictures from around."""

import math
from typing import Any

import numpy as np

from tress.methods.strips.bald_document import HEAD
from tress.model.attachment import surface_mesh
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.strip import Strip
from tress.model.strip_mesh import strips_mesh
from tress.render.flat_scene import FlatScene, flat_scene
from tress.render.gbuffer import rasterise
from tress.render.picture import premultiplied_rgba, srgb_rgb
from tress.render.preview import contact_sheet
from tress.render.styles.photo import PhotoStyle
from tress.render.turntable import BACKDROP
from tress.render.views import framed, pivot, turned

Array = np.ndarray[Any, Any]
Color = tuple[float, float, float]

BROWN: Color = (0.085, 0.038, 0.017)
SKIN = np.array([0.55, 0.33, 0.24])
STREAKS = 14
LIGHT = np.array([0.35, 0.75, 0.55]) / np.linalg.norm([0.35, 0.75, 0.55])
VIEWS = (("front", 0.0, 0.0), ("left", 90.0, 0.0), ("back", 180.0, 0.0), ("right", -90.0, 0.0), ("above", 0.0, 55.0))


def gouraud_scene(document: Document, *, color: Color = BROWN) -> Scene:
    """Head and hair with lit colours at their vertices: every strip in a tone of its own, streaked along."""
    names = sorted(document.of_type(Strip))
    head = surface_mesh(document, HEAD, where="A picture")
    meshes = {HEAD: _colored(head, _skin(head, color))}
    if names:
        hair = strips_mesh(document, names=names, pieces=(3, STREAKS))
        meshes["hair"] = _colored(hair, _hair(hair, color))
    return Scene(meshes=meshes)


def preview(document: Document, *, color: Color = BROWN, height: int = 560) -> Array:
    """(H, W, 3) uint8: the hairdo from four sides and from above."""
    scene = flat_scene(gouraud_scene(document, color=color))
    camera = framed(scene, width=round(0.72 * height), height=height)
    pictures = [_picture(scene, _seen_from(camera, scene, *map(math.radians, angles))) for _, *angles in VIEWS]
    return contact_sheet(pictures, captions=[name for name, *_ in VIEWS], height=height)


def _seen_from(camera: Camera, scene: FlatScene, azimuth_rad: float, elevation_rad: float) -> Camera:
    view = turned(camera, angle_rad=azimuth_rad, pivot_in_world=pivot(scene))
    if not elevation_rad:
        return view
    middle, cos, sin = pivot(scene), math.cos(elevation_rad), math.sin(elevation_rad)
    tilt = np.eye(4)
    tilt[1:3, 1:3] = [[cos, -sin], [sin, cos]]
    tilt[:3, 3] = middle - tilt[:3, :3] @ middle
    return Camera(xy_from_world=view.xy_from_world @ tilt, width=view.width, height=view.height)


def _picture(scene: FlatScene, camera: Camera) -> Array:
    seen = rasterise(scene, xy_from_world=camera.xy_from_world, width=camera.width, height=camera.height)
    return srgb_rgb(premultiplied_rgba(seen, style=PhotoStyle()), background=BACKDROP)


def _colored(mesh: Mesh, color: Array) -> Mesh:
    return Mesh(
        positions=mesh.positions, triangles=mesh.triangles, vertex_attributes={"color": color.astype(np.float32)}
    )


def _skin(mesh: Mesh, color: Color) -> Array:
    scalp = mesh.vertex_attributes["scalp"][:, None]
    base = SKIN * (1 - 0.8 * scalp) + 0.8 * 0.6 * np.asarray(color) * scalp
    facing = _normals(mesh) @ LIGHT
    return base * (0.45 + 0.55 * np.clip(0.5 + 0.5 * facing, 0, 1)[:, None])


def _hair(mesh: Mesh, color: Color) -> Array:
    """Tones of strips and streaks, darker at the root, with a highlight across the hair."""
    strip, fraction = mesh.vertex_attributes["strip"], mesh.vertex_attributes["fraction"]
    tone = 0.8 + 0.4 * _noise(strip, 0)
    column = np.rint(fraction[:, 1] * 3 * STREAKS).astype(np.int64)
    tone = tone * (0.7 + 0.6 * _noise(strip * 131 + column, 1))
    depth = 0.45 + 0.55 * np.clip(fraction[:, 0] / 0.35, 0, 1)
    normal = _normals(mesh)
    along = _along(mesh)
    diffuse = 0.35 + 0.75 * np.clip(0.5 + 0.5 * np.abs(normal @ LIGHT), 0, 1) * np.sqrt(1 - (along @ LIGHT) ** 2)
    half = LIGHT + [0, 0.2, 0]
    glint = np.maximum(1 - (along @ (half / np.linalg.norm(half))) ** 2, 0) ** 24
    return np.asarray(color) * (tone * depth * diffuse)[:, None] * 1.4 * (1 + 0.6 * (glint * depth)[:, None])


def _normals(mesh: Mesh) -> Array:
    corners = mesh.positions[mesh.triangles].astype(np.float64)
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    total = _gathered(mesh, area)
    return total / np.linalg.norm(total, axis=1, keepdims=True).clip(1e-30)


def _along(mesh: Mesh) -> Array:
    """(V, 3) unit directions from root to tip, by the gradient of `fraction` over the triangles."""
    corners = mesh.positions[mesh.triangles].astype(np.float64)
    share = mesh.vertex_attributes["fraction"][mesh.triangles][..., 0].astype(np.float64)
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(a, b)
    slope = (share[:, 1] - share[:, 0])[:, None] * np.cross(b, normal) + (share[:, 2] - share[:, 0])[
        :, None
    ] * np.cross(normal, a)
    total = _gathered(mesh, slope)
    return total / np.linalg.norm(total, axis=1, keepdims=True).clip(1e-30)


def _gathered(mesh: Mesh, per_triangle: Array) -> Array:
    """(V, 3) sums over the triangles around every vertex, in one order."""
    vertex = mesh.triangles.ravel()
    flat = np.repeat(per_triangle, 3, axis=0)
    return np.stack(
        [np.bincount(vertex, weights=flat[:, axis], minlength=len(mesh.positions)) for axis in range(3)], axis=1
    )


def _noise(index: Array, salt: int) -> Array:
    """(N,) float64 in [0, 1), the same for the same index."""
    mixed = (index.astype(np.uint64) + np.uint64(salt * 7919 + 1)) * np.uint64(0x9E3779B97F4A7C15)
    return ((mixed ^ (mixed >> np.uint64(29))) >> np.uint64(11)) / 2.0**53
