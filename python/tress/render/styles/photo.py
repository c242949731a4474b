"""The colours of the photograph as they are, with a little relief for views that the photograph does not show."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from tress.base.params import Params, param
from tress.render.flat_scene import strand_of_point, tangents
from tress.render.gbuffer import GBuffer, HairFragments, hair_fragments
from tress.render.mesh_color import mesh_colors
from tress.render.occlusion import sky_visibility
from tress.render.relief import depth_relief

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class PhotoStyle(Params):
    """Strands in the colours of their points, meshes in their texture, all unlit.

    With every setting at 0, the picture is exactly these colours. For other views than that of the photograph, `soft()`
    gives settings that keep hair from looking like a flat patch.
    """

    name: ClassVar[str] = "photo"

    occlusion: float = param(0.0, low=0, high=1, doc="How much the depths of the hair darken.")
    relief: float = param(0.0, low=0, high=1, doc="How much locks stand out before those behind them.")
    variation: float = param(0.0, low=0, high=1, doc="Spread of the strands' brightness.")
    sheen: float = param(0.0, low=0, high=1, doc="How much light the strands reflect along a highlight.")

    @classmethod
    def soft(cls) -> "PhotoStyle":
        """Settings for views that the photograph does not show."""
        return cls(occlusion=0.65, relief=0.45, variation=0.2, sheen=0.35)

    def shade(self, gbuffer: GBuffer) -> Array:
        """Linear colours (F, 4) float32, straight, of all fragments."""
        rgba = np.ones((len(gbuffer.fragments.weight), 4), np.float32)
        hair = hair_fragments(gbuffer)
        rgba[hair.index, :3] = hair.values(gbuffer.scene.color) * self._brightness(gbuffer, hair)[:, None]
        index, colors = mesh_colors(gbuffer)
        rgba[index, :3] = colors
        return rgba

    def _brightness(self, gbuffer: GBuffer, hair: HairFragments) -> Array:
        factor = np.ones(len(hair.index), np.float32)
        if self.occlusion:
            factor *= 1 - self.occlusion * (1 - relative_light(hair.values(sky_visibility(gbuffer.scene))))
        if self.relief:
            factor *= 1 + self.relief * depth_relief(gbuffer, hair)
        if self.variation:
            factor *= 1 + self.variation * strand_variation(gbuffer)[hair.first]
        if self.sheen:
            factor *= 1 + self.sheen * highlight(gbuffer, hair)
        return factor


def relative_light(visibility: Array) -> Array:
    """Visibility relative to that of open hair (its upper tenth), at most 1."""
    if len(visibility) == 0:
        return visibility
    return np.minimum(visibility / max(float(np.percentile(visibility, 90)), 1e-6), 1)


def strand_variation(gbuffer: GBuffer) -> Array:
    """(N,) float32 in [-1, 1], the same along a strand, uniform over strands (golden-ratio sequence)."""
    strand = strand_of_point(gbuffer.scene)
    return ((strand * 0.6180339887498949) % 1.0 * 2 - 1).astype(np.float32)


def highlight(gbuffer: GBuffer, hair: HairFragments) -> Array:
    """(K,) float32: Kajiya and Kay's highlight for light from above the camera, less its mean over the hair."""
    if len(hair.index) == 0:
        return np.zeros(0, np.float32)
    along = hair.values(tangents(gbuffer.scene))
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-6)
    towards = -gbuffer.away
    light = towards + np.array([0, 1.0, 0])
    half = towards + light / np.linalg.norm(light)
    cosine = along @ (half / np.linalg.norm(half)).astype(np.float32)
    glint = np.power(np.maximum(1 - cosine * cosine, 0), 12)
    return (glint - glint.mean()).astype(np.float32)
