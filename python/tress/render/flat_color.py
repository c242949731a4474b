"""The colour that drawn surfaces have before light: flat, and with sharp borders."""

from typing import Any

import numpy as np

from tress.base.tone_ramp import above
from tress.render.gbuffer import GBuffer
from tress.render.mesh_color import base_color, mesh_color
from tress.render.mesh_fragments import MeshFragments
from tress.render.mesh_frames import is_cards
from tress.render.pixel_steps import with_slope

Array = np.ndarray[Any, Any]


def flat_color(part: MeshFragments, gbuffer: GBuffer) -> Array:
    """(K, 3) float32 linear colours of the fragments of one mesh.

    Strips have the mean of their texture, others their texture itself; then comes the vertex attribute `color`, else
    clay. Where a mesh has the attributes `scalp` (V,) and `scalp_color` (V, 3), its scalp has that colour, with a
    border of one pixel.
    """
    mesh, attributes = part.mesh, part.mesh.vertex_attributes
    if mesh.texture is not None and not is_cards(mesh):
        return mesh_color(part, away=gbuffer.away)
    color = part.values(base_color(mesh)).astype(np.float32)
    if not {"scalp", "scalp_color"} <= set(attributes):
        return color
    scalp = attributes["scalp"][mesh.triangles[part.triangle]]
    share = above(*with_slope(gbuffer, part, lambda shares: np.einsum("kc,kc->k", shares, scalp) - 0.5))
    return (color + share[:, None] * (part.values(attributes["scalp_color"]) - color)).astype(np.float32)
