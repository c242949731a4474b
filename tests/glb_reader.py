"""A reader of GLB that knows nothing of the writer."""

import json
import struct

import numpy as np

COMPONENTS = {5126: "<f4", 5125: "<u4", 5123: "<u2"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def parsed(data):
    """The JSON and the arrays of a file: a reader that knows nothing of the writer."""
    magic, version, length, json_length, json_kind = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, length, json_kind) == (b"glTF", 2, len(data), b"JSON")
    document = json.loads(data[20 : 20 + json_length])
    binary = data[28 + json_length :]
    views = [binary[view["byteOffset"] :][: view["byteLength"]] for view in document.get("bufferViews", [])]
    arrays = [
        np.frombuffer(views[entry["bufferView"]], COMPONENTS[entry["componentType"]]).reshape(-1, WIDTHS[entry["type"]])
        for entry in document.get("accessors", [])
    ]
    return document, arrays, views
