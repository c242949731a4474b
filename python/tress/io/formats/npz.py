"""`reconstruction.npz`: strands, camera and maps of one reconstruction as plain NumPy arrays, for measuring.

Members: `points` (N, 3) float32 metres, `offsets` (S + 1,) int64, `xy_from_points` (3, 4) float64 with last row 0 0 0
1; optional `orientation` (H, W) float32 radians in [0, pi), y down, NaN where not given; `hair_mask` (H, W) uint8;
`rerender` (H, W, 3 | 4) uint8 sRGB, straight alpha.
"""

import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tress.base.errors import FormatError, InputError
from tress.io.archive import DAMAGE, check_size
from tress.io.atomic import atomic_path
from tress.io.file_bytes import read_bytes
from tress.io.format import CAMERA, STRANDS, Format
from tress.io.joined import strands_alone
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.strands import Strands

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Maps:
    """Pictures that belong to a reconstruction, all of the photograph's size; None where there is none.

    `orientation` (H, W) float32 radians, `hair_mask` (H, W) uint8, `rerender` (H, W, 3 | 4) uint8 sRGB.
    """

    orientation: Array | None = None
    hair_mask: Array | None = None
    rerender: Array | None = None


def write_reconstruction(strands: Strands, path: Path, *, camera: Camera, maps: Maps | None = None) -> None:
    """Writes strands, and the camera and the maps that go with them.

    Raises `InputError` where a map has another size than the camera's picture, `OutputError` where writing fails.
    """
    size = (camera.height, camera.width)
    arrays = {"points": strands.points, "offsets": strands.offsets, "xy_from_points": camera.xy_from_world}
    arrays |= {"height_width": np.array(size)} | _checked_maps(maps or Maps(), size)
    with atomic_path(path) as temporary, temporary.open("wb") as file:
        np.savez(file, **arrays)  # pyright: ignore[reportArgumentType]  # NumPy 2.0 has no `allow_pickle` here


def write_npz(document: Document, path: Path) -> None:
    """Writes the strands and the one camera of a document, without maps. Raises `InputError` where either is absent."""
    strands, cameras = strands_alone(document, form=".npz"), document.of_type(Camera)
    if len(cameras) != 1:
        raise InputError(f"The document has {len(cameras)} cameras; a reconstruction has one.")
    write_reconstruction(strands, path, camera=next(iter(cameras.values())))


def read_npz(path: Path) -> Document:
    """A document with the strands (`hair`) and the camera (`photo`) of a reconstruction. Raises `FormatError`."""
    try:
        data = io.BytesIO(read_bytes(path))
        check_size(data)
        with np.load(data, allow_pickle=False) as file:
            arrays = {name: file[name] for name in ("points", "offsets", "xy_from_points", "height_width")}
        height, width = arrays["height_width"].tolist()
    except DAMAGE as error:
        raise FormatError(f"{path} is no reconstruction, or it is damaged.") from error
    try:
        strands = Strands(points=arrays["points"], offsets=arrays["offsets"])
        camera = Camera(xy_from_world=arrays["xy_from_points"], width=width, height=height)
    except InputError as error:
        raise FormatError(f"{path} is damaged: {error}") from error
    return Document({"hair": strands, "photo": camera})


FORMAT = Format("npz", (".npz",), write_npz, read_npz, keeps=frozenset({STRANDS, CAMERA}), strands_alone=True)


def _checked_maps(maps: Maps, size: tuple[int, int]) -> dict[str, Array]:
    wanted = {"orientation": np.float32, "hair_mask": np.uint8, "rerender": np.uint8}
    result = {}
    for name, dtype in wanted.items():
        values = getattr(maps, name)
        if values is None:
            continue
        if values.dtype != dtype or values.shape[:2] != size:
            raise InputError(
                f"Map {name} is {values.dtype} {values.shape}; {np.dtype(dtype)} of {size[0]} x {size[1]} was expected."
            )
        result[name] = values
    return result
