"""The camera of a photograph as an orthographic `UsdGeomCamera`, so that other programs see what it saw.

USD knows no skew, so the exact matrix stands beside it in the namespace `tress`, and is what is read back.
"""

import numpy as np

from tress.io.usd.generic import record_fields, record_prim
from tress.io.usd.prim import Attribute, Prim
from tress.model.camera import Camera
from tress.model.record import Record

DISTANCE_M = 2.0
APERTURE_UNITS_PER_M = 10.0  # USD: tenths of a world unit


def camera_prim(name: str, camera: Camera) -> Prim:
    """The prim of a camera."""
    exact = record_prim(name, camera, nested=_no_prim)
    return Prim(name, "Camera", {**exact.attributes, **_view(camera)}, data=exact.data)


def camera_of(prim: Prim) -> Camera:
    """The camera of a prim."""
    return Camera(**record_fields(prim, Camera, nested=_no_record))


def _view(camera: Camera) -> dict[str, Attribute]:
    """What USD can say of the camera; nothing where its axes are degenerate."""
    rows, shift = camera.xy_from_world[:2, :3], camera.xy_from_world[:2, 3]
    with np.errstate(all="ignore"):
        scale = np.linalg.norm(rows, axis=1)
        right, down = rows / scale[:, None]
        back = np.cross(down, right)
        back /= np.linalg.norm(back)
        size_px = np.array([camera.width, camera.height])
        middle = np.linalg.pinv(rows) @ (size_px / 2 - shift) if np.isfinite(back).all() else np.full(3, np.nan)
        aperture = (APERTURE_UNITS_PER_M * size_px / scale).astype(np.float32)
        pose = np.eye(4)  # USD multiplies row vectors: the axes are the rows
        pose[:3, :3] = right, np.cross(back, right), back
        pose[3, :3] = middle + DISTANCE_M * back
    if not (np.isfinite(pose).all() and np.isfinite(aperture).all()):
        return {}
    return {
        "projection": Attribute("token", "orthographic"),
        "horizontalAperture": Attribute("float", float(aperture[0])),
        "verticalAperture": Attribute("float", float(aperture[1])),
        "clippingRange": Attribute("float2", np.array([0.01, 10.0], np.float32)),
        "xformOp:transform": Attribute("matrix4d", pose),
        "xformOpOrder": Attribute("token[]", ("xformOp:transform",), uniform=True),
    }


def _no_prim(name: str, record: Record) -> Prim:
    raise TypeError(f"a camera holds no {type(record).__name__} {name!r}")


def _no_record(prim: Prim) -> Record:
    raise TypeError(f"a camera holds no {prim.type}")
