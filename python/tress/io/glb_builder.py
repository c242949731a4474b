"""A GLB file in the making: one JSON chunk, one binary chunk, nothing else.

Source: Khronos, glTF 2.0 specification, sections 3.6 (buffers) and 4 (GLB).
"""

import json
import struct
from typing import Any

import numpy as np

ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
COMPONENTS = {"f4": 5126, "u4": 5125, "u2": 5123, "u1": 5121}
SHAPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4"}
POINTS, LINES, TRIANGLES = 0, 1, 4


class GlbBuilder:
    """Collects arrays, pictures and JSON objects; `encoded()` gives the file.

    Each `add_…` returns the index of what it added, for others to name.
    """

    def __init__(self, *, generator: str) -> None:
        self.json: dict[str, Any] = {"asset": {"version": "2.0", "generator": generator}}
        self._parts: list[bytes] = []
        self._size = 0

    def add(self, collection: str, entry: dict[str, Any]) -> int:
        """Appends a JSON object to a top-level array, e.g. "nodes"."""
        entries = self.json.setdefault(collection, [])
        entries.append(entry)
        return len(entries) - 1

    def add_extension(self, name: str) -> None:
        """Names an extension that the file uses."""
        used = self.json.setdefault("extensionsUsed", [])
        if name not in used:
            used.append(name)

    def add_accessor(
        self, values: np.ndarray[Any, Any], *, target: int | None, normalized: bool = False, limits: bool = False
    ) -> int:
        """An accessor over (N,) or (N, 2 | 3 | 4) values of float32, uint32, uint16 or uint8, in rows of whole 4 bytes
        where they are vertices.

        Its limits are written for vectors of three floats, as positions need them, and with `limits`, as times do.
        """
        entry: dict[str, Any] = {
            "bufferView": self._add_view(values.tobytes(), target=target),
            "componentType": COMPONENTS[values.dtype.str[1:]],
            "count": len(values),
            "type": SHAPES[values.shape[1:]],
        }
        if normalized:
            entry["normalized"] = True
        if values.dtype == np.float32 and values.ndim == 2 and values.shape[1] == 3:
            entry |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        elif limits:
            entry |= {"min": [values.min().item()], "max": [values.max().item()]}
        return self.add("accessors", entry)

    def add_png(self, data: bytes, *, name: str) -> int:
        """A picture inside the file."""
        return self.add("images", {"name": name, "mimeType": "image/png", "bufferView": self._add_view(data)})

    def encoded(self) -> bytes:
        """The whole file."""
        binary = b"".join(self._parts)
        document = self.json | ({"buffers": [{"byteLength": len(binary)}]} if binary else {})
        text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
        chunks = _chunk(b"JSON", text, b" ") + (_chunk(b"BIN\0", binary, b"\0") if binary else b"")
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def _add_view(self, data: bytes, *, target: int | None = None) -> int:
        entry: dict[str, Any] = {"buffer": 0, "byteOffset": self._size, "byteLength": len(data)}
        if target is not None:
            entry["target"] = target
        padding = b"\0" * (-len(data) % 4)
        self._parts += [data, padding]
        self._size += len(data) + len(padding)
        return self.add("bufferViews", entry)


def _chunk(kind: bytes, data: bytes, filler: bytes) -> bytes:
    data += filler * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data
