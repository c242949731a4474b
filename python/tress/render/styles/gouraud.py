"""Smooth shading without textures: light at the vertices, interpolated between them."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from tress.base.params import Params, param
from tress.model.mesh import Mesh
from tress.render.gbuffer import GBuffer, hair_fragments
from tress.render.light import light_direction
from tress.render.mesh_color import base_color
from tress.render.mesh_fragments import mesh_fragments
from tress.render.mesh_frames import is_cards, mesh_frames, vertex_normals
from tress.render.occlusion import mesh_light_transmittance, mesh_sky_visibility
from tress.render.strip_light import WRAP, Gloss, StripSurface, lit_strips

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class GouraudStyle(Params):
    """One distant light, given relative to the camera, and a uniform sky, both dimmed by the strips before them.

    Meshes show the vertex attribute `color`, else the mean of their texture, else clay; strips have two highlights
    across the hair. Single strands are in their own colours, unlit. Source: Gouraud 1971; Koh & Huang, section 5.
    """

    name: ClassVar[str] = "gouraud"

    azimuth_rad: float = param(0.5, low=-np.pi, high=np.pi, unit="rad", doc="Light to the right of the camera.")
    elevation_rad: float = param(0.8, low=-1.5, high=1.5, unit="rad", doc="Light above the camera.")
    light: float = param(1.6, low=0, high=100, doc="Light of the lamp, as a multiple of the colour.")
    sky: float = param(0.65, low=0, high=10, doc="Light from all around, as a multiple of the colour.")
    shine: float = param(0.05, low=0, high=10, doc="Strength of the highlight in the colour of the light.")
    sheen: float = param(0.8, low=0, high=10, doc="Strength of the highlight in the colour of the hair.")
    gloss: float = param(60.0, low=1, high=2000, doc="Exponent of the highlight; larger is narrower.")
    tilt: float = param(0.12, low=0, high=1, doc="How far the highlights lie from the place of a mirror.")

    def shade(self, gbuffer: GBuffer) -> Array:
        """Linear colours (F, 4) float32, straight, of all fragments."""
        rgba = np.ones((len(gbuffer.fragments.weight), 4), np.float32)
        hair = hair_fragments(gbuffer)
        rgba[hair.index, :3] = hair.values(gbuffer.scene.color)
        to_light = light_direction(gbuffer, azimuth_rad=self.azimuth_rad, elevation_rad=self.elevation_rad)
        sky = mesh_sky_visibility(gbuffer.scene)
        light = mesh_light_transmittance(gbuffer.scene, towards_light=to_light)
        for part in mesh_fragments(gbuffer):
            reached = Reached(sky[part.vertices], light[part.vertices], to_light, -gbuffer.away)
            rgba[part.index, :3] = part.values(self._at_vertices(part.mesh, reached))
        return rgba

    def _at_vertices(self, mesh: Mesh, reached: "Reached") -> Array:
        color = base_color(mesh)
        if not is_cards(mesh):
            return lit_surface(color, vertex_normals(mesh), reached, light=self.light, sky=self.sky)
        frames = mesh_frames(mesh)
        surface = StripSurface(
            color=color,
            normal=facing(frames.normal, reached.to_eye),
            along=frames.along,
            sky=reached.sky,
            light=reached.light,
            shift=np.zeros(len(color)),
        )
        gloss = Gloss(self.shine, self.sheen, self.gloss, self.tilt)
        return lit_strips(
            surface, to_light=reached.to_light, to_eye=reached.to_eye, gloss=gloss, light=self.light, sky=self.sky
        )


@dataclass(frozen=True, eq=False)
class Reached:
    """What light reaches K places: shares of `sky` and `light` (K,), the directions `to_light` and `to_eye` (3,)."""

    sky: Array
    light: Array
    to_light: Array
    to_eye: Array


def lit_surface(color: Array, normal: Array, reached: Reached, *, light: float, sky: float) -> Array:
    """(K, 3) float32: the diffuse light of skin and the like, which wraps around a little."""
    body = np.clip((normal @ reached.to_light + WRAP) / (1 + WRAP), 0, 1)
    return (color * (sky * reached.sky + light * reached.light * body)[:, None]).astype(np.float32)


def facing(normal: Array, to_eye: Array) -> Array:
    """Normals (K, 3), turned round where they look away from the viewer: strips have two sides."""
    return normal * np.where(normal @ to_eye < 0, -1, 1)[:, None].astype(np.float32)
