"""What a GLB file holds, by its description alone: no buffer is read."""

import json
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tress.base.errors import FormatError, InputError

MAGIC, JSON_CHUNK, VERSION = b"glTF", b"JSON", 2
TRIANGLES = 4


@dataclass(frozen=True)
class GlbPart:
    """A mesh, clip or texture of a file: its name, its kind and what it holds, in words."""

    name: str
    kind: str
    holds: str


def glb_summary(path: Path) -> list[GlbPart]:
    """The meshes, clips and pictures of a GLB file, in its order.

    Raises `InputError` where there is no file, `FormatError` where it is no glTF 2.0 in one file.
    """
    if not path.is_file():
        raise InputError(f"{path} does not exist; name a GLB file.")
    with path.open("rb") as file:
        header = file.read(20)
        if len(header) < 20 or header[:4] != MAGIC or header[16:20] != JSON_CHUNK:
            raise FormatError(f"{path} is no GLB file: it does not begin as one.")
        version, _, length = struct.unpack("<III", header[4:16])
        if version != VERSION:
            raise FormatError(f"{path} is glTF {version}; version {VERSION} was expected.")
        text = file.read(min(length, path.stat().st_size))
    try:
        return _parts(json.loads(text))
    except (ValueError, RecursionError, LookupError, TypeError, AttributeError) as error:
        raise FormatError(f"{path} is a GLB file whose description cannot be read: {error}.") from error


def _parts(gltf: dict[str, Any]) -> list[GlbPart]:
    accessors = gltf.get("accessors", [])
    meshes = [_mesh(number, mesh, accessors) for number, mesh in enumerate(gltf.get("meshes", []))]
    clips = [_clip(number, clip, accessors) for number, clip in enumerate(gltf.get("animations", []))]
    pictures = [
        GlbPart(str(image.get("name", f"image {number}")), "picture", str(image.get("mimeType", "a file beside it")))
        for number, image in enumerate(gltf.get("images", []))
    ]
    return meshes + clips + pictures


def _mesh(number: int, mesh: dict[str, Any], accessors: list[dict[str, Any]]) -> GlbPart:
    vertices = triangles = targets = 0
    for primitive in mesh["primitives"]:
        count = int(accessors[primitive["attributes"]["POSITION"]]["count"])
        corners = int(accessors[primitive["indices"]]["count"]) if "indices" in primitive else count
        vertices += count
        triangles += corners // 3 if primitive.get("mode", TRIANGLES) == TRIANGLES else 0
        targets = max(targets, len(primitive.get("targets", ())))
    moves = f", {targets} morph targets" if targets else ""
    return GlbPart(
        str(mesh.get("name", f"mesh {number}")), "mesh", f"{vertices:,} vertices, {triangles:,} triangles{moves}"
    )


def _clip(number: int, clip: dict[str, Any], accessors: list[dict[str, Any]]) -> GlbPart:
    ends = [float(accessors[sampler["input"]].get("max", [0.0])[0]) for sampler in clip["samplers"]]
    return GlbPart(str(clip.get("name", f"clip {number}")), "clip", f"{max(ends, default=0.0):.2f} s")
