"""Hair under one light: scattering of fibres, shadows within the hair, soft light from all around."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from tress.base.params import Params, param
from tress.render.fibre_scattering import Fibre, scattering
from tress.render.flat_scene import tangents
from tress.render.gbuffer import GBuffer, HairFragments, hair_fragments
from tress.render.light import light_direction
from tress.render.mesh_color import mesh_colors
from tress.render.occlusion import light_transmittance, sky_visibility

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class FibreStyle(Params):
    """One distant light, given relative to the camera, and a uniform sky; meshes in their own colours, unlit."""

    name: ClassVar[str] = "fibre"

    azimuth_rad: float = param(0.6, low=-np.pi, high=np.pi, unit="rad", doc="Light to the right of the camera.")
    elevation_rad: float = param(0.7, low=-1.5, high=1.5, unit="rad", doc="Light above the camera.")
    light: float = param(5.5, low=0, high=100, doc="Irradiance; the default shows hair about as bright as its colour.")
    sky: float = param(0.7, low=0, high=10, doc="Light from all around, as a multiple of the hair's colour.")
    roughness_rad: float = param(0.1, low=0.02, high=0.6, unit="rad", doc="Width of the highlight along the hair.")
    tilt_rad: float = param(0.05, low=0.0, high=0.2, unit="rad", doc="Tilt of the cuticle, which moves the highlights.")

    def shade(self, gbuffer: GBuffer) -> Array:
        """Linear colours (F, 4) float32, straight, of all fragments."""
        rgba = np.ones((len(gbuffer.fragments.weight), 4), np.float32)
        hair = hair_fragments(gbuffer)
        rgba[hair.index, :3] = self._hair(gbuffer, hair)
        index, colors = mesh_colors(gbuffer)
        rgba[index, :3] = colors
        return rgba

    def towards_light(self, gbuffer: GBuffer) -> Array:
        """(3,) float64 unit direction of the light in the world."""
        return light_direction(gbuffer, azimuth_rad=self.azimuth_rad, elevation_rad=self.elevation_rad)

    def _hair(self, gbuffer: GBuffer, hair: HairFragments) -> Array:
        if len(hair.index) == 0:
            return np.zeros((0, 3), np.float32)
        scene, light = gbuffer.scene, self.towards_light(gbuffer).astype(np.float32)
        along = hair.values(tangents(scene))
        along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-6)
        color = hair.values(scene.color)
        fibre = Fibre(self.roughness_rad, self.tilt_rad)
        eye = (-gbuffer.away).astype(np.float32)
        leaving = scattering(along, to_light=light, to_eye=eye, color=color, fibre=fibre)
        cosine = np.sqrt(np.maximum(1 - (along @ light) ** 2, 0))
        lit = self.light * cosine * hair.values(light_transmittance(scene, towards_light=light))
        sky = self.sky * hair.values(sky_visibility(scene))
        return leaving * lit[:, None] + color * sky[:, None]
