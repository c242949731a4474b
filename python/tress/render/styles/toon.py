"""Cel shading: flat tones by the angle to the light, a ring of light on the hair, and lines of even width.

Source: Modelling and Animating Cartoon Hair, section 3, Cartoon Shading; Lake et al. 2000 (see `tone_ramp`).
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from tress.base.params import Params, param
from tress.base.tone_ramp import ToneParams, above, gleaming, tone_ramp
from tress.model.melded_normals import body_normals, melded
from tress.render.flat_color import flat_color
from tress.render.gbuffer import GBuffer, hair_fragments
from tress.render.light import light_direction
from tress.render.mesh_fragments import MeshFragments, mesh_fragments
from tress.render.mesh_frames import is_cards, vertex_normals
from tress.render.outline import OutlineParams, outlines
from tress.render.pixel_steps import with_slope
from tress.render.ring import RingParams, body_along, lens_across, ring_by_fraction, ring_by_light
from tress.render.views import pivot

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class ToonStyle(Params):
    """One distant light, given relative to the camera; no shadows are cast.

    Meshes show the vertex attribute `color`, else the mean of their texture, strips the latter; single strands their
    own colours. Edges of tones are one pixel sharp. Lines are drawn over the picture and half beyond its silhouette.
    """

    name: ClassVar[str] = "toon"

    azimuth_rad: float = param(0.45, low=-np.pi, high=np.pi, unit="rad", doc="Light to the right of the camera.")
    elevation_rad: float = param(0.65, low=-1.5, high=1.5, unit="rad", doc="Light above the camera.")
    meld: float = param(0.6, low=0, high=1, doc="How far clumps are shaded as one round body of hair.")
    tones: ToneParams = field(default_factory=ToneParams)
    ring: RingParams = field(default_factory=RingParams)
    lines: OutlineParams = field(default_factory=OutlineParams)

    def shade(self, gbuffer: GBuffer) -> Array:
        """Linear colours (F, 4) float32, straight, of all fragments."""
        rgba = np.ones((len(gbuffer.fragments.weight), 4), np.float32)
        if len(rgba) == 0:
            return rgba
        to_light = light_direction(gbuffer, azimuth_rad=self.azimuth_rad, elevation_rad=self.elevation_rad)
        centre, ramp = pivot(gbuffer.scene), tone_ramp(self.tones)
        hair = hair_fragments(gbuffer)
        if len(hair.index):
            body = body_normals(hair.values(gbuffer.scene.points), centre=centre)
            rgba[hair.index, :3] = ramp.of(hair.values(gbuffer.scene.color), body @ to_light)
        for part in mesh_fragments(gbuffer):
            if len(part.index):
                lit = Lit(part, gbuffer, to_light, body_normals(part.mesh.positions, centre=centre), self.meld)
                cosine, slope = melded_cosine(lit)
                shown = ramp.of(flat_color(part, gbuffer), cosine, slope=slope)
                rgba[part.index, :3] = _ringed(shown, lit, self.ring)
        return rgba

    def drawn_lines(self, gbuffer: GBuffer) -> Array:
        """(H, W, 4) float32 linear, premultiplied: the outlines."""
        return outlines(gbuffer, params=self.lines)


@dataclass(frozen=True, eq=False)
class Lit:
    """The fragments of one mesh under the light: `to_light` (3,), `body` (V, 3) normals of all hair as one, and the
    `share` of these."""

    part: MeshFragments
    gbuffer: GBuffer
    to_light: Array
    body: Array
    share: float

    def at_corners(self, per_vertex: Array) -> Array:
        """(K, 3, ...) values (V, ...) at the corners of the fragments' triangles."""
        return per_vertex[self.part.mesh.triangles[self.part.triangle]]


def melded_cosine(lit: Lit) -> tuple[Array, Array]:
    """(K,) cosines of the normals to the light, and how much they change within a pixel."""
    mesh, to_eye = lit.part.mesh, -lit.gbuffer.away
    own = vertex_normals(mesh).astype(np.float64)
    towards = lit.at_corners(own @ to_eye).sum(axis=1)
    # Strips have two sides: all corners of a triangle are turned alike, or the tone would jump within it.
    both = is_cards(mesh)
    front = melded(own, lit.body, share=lit.share) @ lit.to_light
    cosine = lit.at_corners(front)
    if both:
        back = melded(-own, lit.body, share=lit.share) @ lit.to_light
        cosine = np.where(towards[:, None] < 0, lit.at_corners(back), cosine)
    return with_slope(lit.gbuffer, lit.part, lambda shares: np.einsum("kc,kc->k", shares, cosine))


def _ringed(shown: Array, lit: Lit, params: RingParams) -> Array:
    mesh = lit.part.mesh
    if params.by == "none" or not is_cards(mesh) or "strip" not in mesh.vertex_attributes:
        return shown
    value = _by_fraction(lit, params) if params.by == "fraction" else _by_light(lit, params)
    inside = above(*with_slope(lit.gbuffer, lit.part, value))[:, None]
    return (shown + inside * (gleaming(shown, gleam=params.gleam) - shown)).astype(np.float32)


def _by_fraction(lit: Lit, params: RingParams) -> Callable[[Array], Array]:
    mesh = lit.part.mesh
    values = lit.at_corners(np.stack([mesh.vertex_attributes["fraction"][:, 0], lens_across(mesh)], axis=1))

    def value(shares: Array) -> Array:
        fraction, lens = np.einsum("kc,kcd->dk", shares, values)
        return ring_by_fraction(fraction, lens=lens, params=params)

    return value


def _by_light(lit: Lit, params: RingParams) -> Callable[[Array], Array]:
    mesh = lit.part.mesh
    half = lit.to_light - lit.gbuffer.away
    half = half / max(float(np.linalg.norm(half)), 1e-9)
    along = body_along(lit.body)
    values = lit.at_corners(np.stack([along @ half, lit.body @ half, lens_across(mesh)], axis=1))

    def value(shares: Array) -> Array:
        sine, facing, lens = np.einsum("kc,kcd->dk", shares, values)
        return ring_by_light(sine, facing=facing, lens=lens, params=params)

    return value
