"""Run by a Python with `bpy`: imports a file and prints a line of JSON about its meshes."""

import json
import sys

import bpy
import numpy as np

FRAMES = 24


def positions(item, frame):
    """Vertices of an object as they are shown in a frame, in the world."""
    bpy.context.scene.frame_set(frame)
    shown = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    found = np.array([shown.matrix_world @ vertex.co for vertex in mesh.vertices])
    shown.to_mesh_clear()
    return found


def described(item):
    """What the tests ask of a mesh."""
    keys = item.data.shape_keys
    frames = [positions(item, frame) for frame in range(0, FRAMES + 1, 6)]
    moved = max(float(np.linalg.norm(frame - frames[0], axis=1).max()) for frame in frames)
    return {
        "vertices": len(item.data.vertices),
        "shape_keys": len(keys.key_blocks) if keys else 0,
        "moved": moved,
    }


bpy.ops.wm.read_factory_settings(use_empty=True)
if sys.argv[1].endswith(".glb"):
    bpy.ops.import_scene.gltf(filepath=sys.argv[1])
else:
    bpy.ops.wm.usd_import(filepath=sys.argv[1])
meshes = {item.name: described(item) for item in bpy.data.objects if item.type == "MESH"}
print(json.dumps({"meshes": meshes}))
