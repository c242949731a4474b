"""A reconstruction as a document: head, hair, camera and recipe, in the head frame."""

import hashlib

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from tress.base.color import linear_to_srgb
from tress.head.fit import FittedHead
from tress.head.texture import head_texture
from tress.image.labels import FACE
from tress.kernel.strands import transformed
from tress.methods.portrait.color import ColoredHair
from tress.methods.portrait.grow import GrownHair
from tress.methods.portrait.head import PortraitHead
from tress.methods.portrait.stage import Work
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.evaluate import Scene
from tress.model.head import MASKS, Head
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe, flat_parameters
from tress.model.strands import Strands
from tress.model.texture import Texture

HIDDEN_RADIUS_M = 1e-4
"""Half the width of a strand that stands for the two or three hairs of 0.08 mm around it."""
VISIBLE_RADIUS_PX = 0.55
"""Half the width of a strand on the photo's surface: neighbours, a pixel apart, close up and leave no gap."""

CLOSE_ROOTS = 12
"""Roots by which it is told how closely they stand."""
ROOTS_WITHIN = 0.006
"""Metres within which so many stand where hair is dense; none of it is left at twice as far."""


def portrait_document(work: Work) -> Document:
    """The document of a finished `work`: `head`, `hair`, `photo` and `recipe`."""
    head: PortraitHead = work["head"]
    colored: ColoredHair = work["color"]
    return Document(
        {
            "head": head_record(head.fitted, texture=_texture(work)),
            "hair": hair_record(head.fitted, grown=work["strands"], color=colored.color, alpha=colored.alpha),
            "photo": photo_camera(head.fitted, shape=work.pixels.shape[:2]),
            "recipe": Recipe(
                method="portrait",
                seed=work.params.seed,
                parameters=flat_parameters(work.params),
                inputs={"photo_pixels": hashlib.sha256(work.pixels.tobytes()).hexdigest()},
            ),
        }
    )


def bare_scene(fitted: FittedHead, *, grown: GrownHair) -> Scene:
    """The strands in the colours that they grew with, and the head without texture: what visibility needs."""
    hair = hair_record(fitted, grown=grown, color=grown.color, alpha=grown.alpha)
    return Scene(strands={"hair": hair}, meshes={"head": head_record(fitted).mesh})


def photo_camera(fitted: FittedHead, *, shape: tuple[int, ...]) -> Camera:
    """The camera of the photo of `shape` (H, W), seen from the head frame."""
    height, width = shape
    return Camera(xy_from_world=fitted.xy_from_view @ fitted.view_from_head, width=width, height=height)


def head_record(fitted: FittedHead, *, texture: NDArray[np.uint8] | None = None) -> Head:
    """The fitted head in the head frame, with its masks, and its `texture` (S, S, 3) uint8 sRGB if there is one."""
    mesh = Mesh(
        positions=in_head(fitted.positions_in_view, fitted.view_from_head),
        triangles=fitted.triangles,
        corner_uv=fitted.corner_uv,
        vertex_attributes={name: fitted.masks[name] for name in MASKS if name in fitted.masks},
        texture=None if texture is None else Texture(pixels=texture),
    )
    return Head(
        mesh=mesh,
        shape=fitted.shape.astype(np.float32),
        expression=fitted.expression.astype(np.float32),
        landmarks_px=fitted.landmarks.points,
    )


def hair_record(
    fitted: FittedHead, *, grown: GrownHair, color: NDArray[np.float32], alpha: NDArray[np.float32]
) -> Strands:
    """The grown strands in the head frame, in `color` (N, 3) linear and opacity `alpha` (N,)."""
    return Strands(
        points=in_head(grown.points, fitted.view_from_head),
        offsets=grown.offsets,
        point_attributes={
            "color": color,
            "alpha": alpha,
            "radius": strand_radius_m(grown, px_per_metre=fitted.px_per_metre),
        },
        strand_attributes={"visible": grown.visible},
    )


def strand_radius_m(grown: GrownHair, *, px_per_metre: float) -> NDArray[np.float32]:
    """Half the width (N,) float32 at every point: what shows is as wide as a pixel, the rest thin."""
    radius_m = np.where(grown.visible, VISIBLE_RADIUS_PX / px_per_metre, HIDDEN_RADIUS_M).astype(np.float32)
    return np.repeat(radius_m, np.diff(grown.offsets))


def in_head(points_in_view: NDArray[np.floating], view_from_head: NDArray[np.float64]) -> NDArray[np.float32]:
    """Points (N, 3) of the view frame in the head frame: the inverse of the rigid `view_from_head` (4, 4)."""
    head_from_view = np.eye(4)
    head_from_view[:3, :3] = view_from_head[:3, :3].T
    head_from_view[:3, 3] = -(view_from_head[:3, :3].T * view_from_head[:3, 3]).sum(axis=1)
    return transformed(points_in_view, transform=head_from_view)


def _texture(work: Work) -> NDArray[np.uint8]:
    """The head's texture: skin where the photo shows it, tinted by the hair's roots on the scalp."""
    skin = (work["layers"].label == FACE) * (1 - work["matte"].alpha)
    fitted, grown = work["head"].fitted, work["strands"]
    return head_texture(
        work.pixels,
        fitted=fitted,
        skin=skin,
        scalp_color=_root_color(grown),
        scalp_cover=_root_cover(grown, fitted.positions_in_view) * (1 - fitted.masks["face"]),
    )


def _root_cover(grown: GrownHair, positions: NDArray[np.floating]) -> NDArray[np.float32]:
    """(V,) in [0, 1]: how closely roots stand around each of the head's `positions` (V, 3)."""
    roots = grown.points[grown.offsets[:-1]][grown.rooted]
    if len(roots) == 0:
        return np.zeros(len(positions), np.float32)
    reach = KDTree(roots).query(positions, k=min(CLOSE_ROOTS, len(roots)))[0].reshape(len(positions), -1)[:, -1]
    return np.clip(2 - reach / ROOTS_WITHIN, 0, 1).astype(np.float32)


def _root_color(grown: GrownHair) -> NDArray[np.float32] | None:
    """The median colour (3,) sRGB in [0, 1] of the hair where it leaves the head; None without hair."""
    roots = grown.color[grown.offsets[:-1]]
    return linear_to_srgb(np.median(roots, axis=0)) if len(roots) else None
