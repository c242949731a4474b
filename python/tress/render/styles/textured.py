"""Strips with their textures: colours, normals and flow of the atlas, and highlights across the flow."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from tress.base.color import srgb_to_linear
from tress.base.params import Params, param
from tress.render.gbuffer import GBuffer, hair_fragments
from tress.render.light import light_direction
from tress.render.mesh_color import base_color, mesh_color
from tress.render.mesh_fragments import MeshFragments, mesh_fragments
from tress.render.mesh_frames import is_cards, mesh_frames, vertex_normals
from tress.render.occlusion import mesh_light_transmittance, mesh_sky_visibility
from tress.render.strip_light import Gloss, StripSurface, lit_strips
from tress.render.styles.gouraud import Reached, facing, lit_surface
from tress.render.texture_levels import TexturePlaces, texture_places
from tress.render.textures.encode import directions, shares

Array = np.ndarray[Any, Any]

_DOWN = np.array([0.0, -1.0, 0.0], np.float32)
_OUT = np.array([0.0, 0.0, 1.0], np.float32)


@dataclass(frozen=True)
class TexturedStyle(Params):
    """One distant light, given relative to the camera, and a uniform sky, both dimmed by the strips before them.

    Strips take colour, `normal`, `flow` and `strand_id` of their atlas as far as there are such maps; other meshes
    their texture or colours, lit as well. Single strands are in their own colours, unlit. Source of the highlights:
    Scheuermann 2004 (see `strip_light`).
    """

    name: ClassVar[str] = "textured"

    azimuth_rad: float = param(0.5, low=-np.pi, high=np.pi, unit="rad", doc="Light to the right of the camera.")
    elevation_rad: float = param(0.8, low=-1.5, high=1.5, unit="rad", doc="Light above the camera.")
    light: float = param(1.6, low=0, high=100, doc="Light of the lamp, as a multiple of the colour.")
    sky: float = param(0.65, low=0, high=10, doc="Light from all around, as a multiple of the colour.")
    shine: float = param(0.015, low=0, high=10, doc="Strength of the highlight in the colour of the light.")
    sheen: float = param(0.9, low=0, high=10, doc="Strength of the highlight in the colour of the hair.")
    gloss: float = param(60.0, low=1, high=2000, doc="Exponent of the highlight; larger is narrower.")
    tilt: float = param(0.12, low=0, high=1, doc="How far the highlights lie from the place of a mirror.")
    jitter: float = param(0.1, low=0, high=1, doc="How far highlights of single strands stray from those of the strip.")
    relief: float = param(0.5, low=0, high=1, doc="How much of the texture's normals shows.")

    def shade(self, gbuffer: GBuffer) -> Array:
        """Linear colours (F, 4) float32, straight, of all fragments."""
        rgba = np.ones((len(gbuffer.fragments.weight), 4), np.float32)
        hair = hair_fragments(gbuffer)
        rgba[hair.index, :3] = hair.values(gbuffer.scene.color)
        to_light = light_direction(gbuffer, azimuth_rad=self.azimuth_rad, elevation_rad=self.elevation_rad)
        sky = mesh_sky_visibility(gbuffer.scene)
        light = mesh_light_transmittance(gbuffer.scene, towards_light=to_light)
        for part in mesh_fragments(gbuffer):
            if len(part.index) == 0:
                continue
            reached = Reached(
                part.values(sky[part.vertices]), part.values(light[part.vertices]), to_light, -gbuffer.away
            )
            shaded = self._strips if is_cards(part.mesh) else self._surface
            rgba[part.index, :3] = shaded(part, gbuffer, reached)
        return rgba

    def _surface(self, part: MeshFragments, gbuffer: GBuffer, reached: Reached) -> Array:
        plain = part.mesh.texture is None
        color = part.values(base_color(part.mesh)) if plain else mesh_color(part, away=gbuffer.away)
        return lit_surface(
            color, _unit(part.values(vertex_normals(part.mesh))), reached, light=self.light, sky=self.sky
        )

    def _strips(self, part: MeshFragments, gbuffer: GBuffer, reached: Reached) -> Array:
        places = None if part.mesh.texture is None else texture_places(gbuffer, part)
        color = part.values(base_color(part.mesh)) if places is None else _texture_color(part, places)
        normal, along = self._directions(part, places, reached.to_eye)
        surface = StripSurface(
            color=color,
            normal=normal,
            along=along,
            sky=reached.sky,
            light=reached.light,
            shift=self.jitter * _stray(part, places),
        )
        gloss = Gloss(self.shine, self.sheen, self.gloss, self.tilt)
        return lit_strips(
            surface, to_light=reached.to_light, to_eye=reached.to_eye, gloss=gloss, light=self.light, sky=self.sky
        )

    def _directions(self, part: MeshFragments, places: TexturePlaces | None, to_eye: Array) -> tuple[Array, Array]:
        """Normals towards the viewer and the ways of the strands, from the maps where there are such."""
        frames = mesh_frames(part.mesh)
        outwards = facing(_unit(part.values(frames.normal)), to_eye)
        axes = np.stack([part.values(frames.across), -part.values(frames.along), outwards], axis=-1)
        bumps = _OUT + self.relief * (_directions_of(part, places, "normal", _OUT) - _OUT)
        normal = _unit(np.einsum("kij,kj->ki", axes, bumps))
        along = _unit(np.einsum("kij,kj->ki", axes, _directions_of(part, places, "flow", _DOWN)))
        return normal, along


def _texture_color(part: MeshFragments, places: TexturePlaces) -> Array:
    """The colours of the texture, times the vertex attribute `color` where there is one."""
    assert part.mesh.texture is not None
    color = places.read(part.mesh.texture.pixels[..., :3], decode=srgb_to_linear)
    return (
        color * part.values(part.mesh.vertex_attributes["color"]) if "color" in part.mesh.vertex_attributes else color
    )


def _directions_of(part: MeshFragments, places: TexturePlaces | None, name: str, default: Array) -> Array:
    if places is None or name not in part.maps:
        return np.broadcast_to(default, (len(part.index), 3))
    return places.read(part.maps[name], decode=directions)


def _stray(part: MeshFragments, places: TexturePlaces | None) -> Array:
    """(K,) in [-1, 1]: a number of the strand, 0 where strands have none."""
    if places is None or "strand_id" not in part.maps:
        return np.zeros(len(part.index), np.float32)
    noise = np.random.default_rng(0).permutation(256).astype(np.uint8)
    return 2 * places.read(noise[part.maps["strand_id"]], decode=shares)[:, 0] - 1


def _unit(vectors: Array) -> Array:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True).clip(1e-9)
