"""One bicubic strip as 88, 35 and 12 polygons: `python examples/nurbs_strip.py OUT.png`."""

import sys

import cv2
import numpy as np

from tress.kernel.nurbs import Patch, patch
from tress.kernel.tessellation import Tessellation, tessellate_segments

HEIGHT, WIDTH = 520, 260
LEVELS = ((11, 8), (7, 5), (4, 3))
LIGHT = np.array([0.4, 0.5, 0.77])
HAIR_BGR = np.array([52, 92, 150.0])


def strip() -> Patch:
    """A strip of 8 x 4 control points, 0.22 m long, that curls forwards and tapers to a point at its tip."""
    t, s = np.meshgrid(np.linspace(0, 1, 8), np.linspace(-0.5, 0.5, 4), indexing="ij")
    width = 0.06 * np.sqrt(1 - t)
    x = 0.035 * np.sin(4 * t) + width * s
    y = -0.22 * t
    z = 0.05 * np.sin(3 * t) - 2 * width * s**2
    return patch(np.stack([x, y, z], axis=-1))


def picture(mesh: Tessellation) -> np.ndarray:
    """(HEIGHT, WIDTH, 3) uint8 BGR: the shaded polygons with their edges, seen from the front."""
    canvas = np.full((HEIGHT, WIDTH, 3), 250, np.uint8)
    pixels = np.column_stack([110 + 1900 * mesh.positions[:, 0], 50 - 1900 * mesh.positions[:, 1]])
    depth = mesh.positions[mesh.triangles, 2].mean(axis=1)
    for corners in mesh.triangles[np.argsort(depth)]:
        shade = 0.35 + 0.75 * abs(float(mesh.normals[corners].mean(axis=0) @ LIGHT))
        outline = [np.round(pixels[corners] * 16).astype(np.int32)]
        cv2.fillPoly(canvas, outline, np.minimum(HAIR_BGR * shade, 255).tolist(), cv2.LINE_AA, 4)
        cv2.polylines(canvas, outline, True, (30, 40, 60), 1, cv2.LINE_AA, 4)
    label = f"{mesh.polygons[0]} polygons"
    cv2.putText(canvas, label, (20, 28), cv2.FONT_HERSHEY_SIMPLEX, 0.6, (40, 40, 40), 1, cv2.LINE_AA)
    return canvas


if __name__ == "__main__":
    levels = [tessellate_segments(strip(), segments=segments) for segments in LEVELS]
    cv2.imwrite(sys.argv[1], np.hstack([picture(level) for level in levels]))
