"""A reconstruction as a document: head, hair, camera and recipe, in the head frame."""

import hashlib

import numpy as np
from numpy.typing import NDArray

from tress.head.fit import FittedHead
from tress.methods.portrait.head import PortraitHead
from tress.methods.portrait.stage import Work
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.head import MASKS, Head
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe, flat_parameters


def portrait_document(work: Work) -> Document:
    """The document of a finished `work`: `head`, `photo` and `recipe`."""
    head: PortraitHead = work["head"]
    return Document(
        {
            "head": head_record(head.fitted),
            "photo": photo_camera(head.fitted, shape=work.pixels.shape[:2]),
            "recipe": Recipe(
                method="portrait",
                seed=work.params.seed,
                parameters=flat_parameters(work.params),
                inputs={"photo_pixels": hashlib.sha256(work.pixels.tobytes()).hexdigest()},
            ),
        }
    )


def photo_camera(fitted: FittedHead, *, shape: tuple[int, int]) -> Camera:
    """The camera of the photo of `shape` (H, W), seen from the head frame."""
    height, width = shape
    return Camera(xy_from_world=fitted.xy_from_view @ fitted.view_from_head, width=width, height=height)


def head_record(fitted: FittedHead) -> Head:
    """The fitted head in the head frame, with its masks."""
    mesh = Mesh(
        positions=in_head(fitted.positions_in_view, fitted.view_from_head).astype(np.float32),
        triangles=fitted.triangles,
        corner_uv=fitted.corner_uv,
        vertex_attributes={name: fitted.masks[name] for name in MASKS if name in fitted.masks},
    )
    return Head(
        mesh=mesh,
        shape=fitted.shape.astype(np.float32),
        expression=fitted.expression.astype(np.float32),
        landmarks_px=fitted.landmarks.points,
    )


def in_head(points_in_view: NDArray[np.floating], view_from_head: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (N, 3) of the view frame in the head frame: the inverse of the rigid `view_from_head` (4, 4)."""
    return (points_in_view - view_from_head[:3, 3]) @ view_from_head[:3, :3]
