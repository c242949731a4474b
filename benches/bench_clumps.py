"""From a surface to the meshes of its clumps, at every frame anew: 300 key hairs of 16 points, on one core."""

import os
import statistics
import subprocess
import sys
import time

import numpy as np
from rich.console import Console

from tress.kernel import nurbs
from tress.methods.cartoon.clump import swept
from tress.methods.cartoon.key_hairs import key_hairs
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.model.strip import Strip
from tress.model.strip_grid import strip_grid

HAIRS, POINTS, FRAMES, PIECES = 300, 16, 60, (2, 2)


def surface(moment: float) -> nurbs.Patch:
    """A curtain in a wind."""
    u, v = np.meshgrid(np.linspace(0, 1, 8), np.linspace(0, 1, 12), indexing="ij")
    return nurbs.patch(np.stack([v, -0.4 * u, 0.1 * u * np.sin(6 * v + 5 * u - moment)], axis=-1))


def main() -> None:
    """Runs in a process of its own, which is held to one core."""
    environment = {**os.environ, "RAYON_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    subprocess.run([sys.executable, "-m", "benches.bench_clumps"], env=environment, check=True)


if __name__ == "__main__":
    hairs, shape = KeyHairParams(hairs=HAIRS, points=POINTS), ClumpParams(vertical_radius=0.001)
    first = swept(key_hairs(surface(0.0), params=hairs), params=shape)
    strips = [
        Strip(points=net, weights=first.weights, knots_u=first.knots_u, knots_v=first.knots_v) for net in first.points
    ]
    grid = strip_grid(strips, pieces=PIECES)
    seconds = []
    for moment in np.linspace(0, 2, FRAMES):
        patch = surface(moment)
        start = time.process_time()
        found = swept(key_hairs(patch, params=hairs), params=shape)
        grid.points(found.points.reshape(-1, 3))
        seconds.append(time.process_time() - start)
    Console().print(
        f"{HAIRS} clumps of {POINTS} points, surface to mesh: {1 / statistics.median(seconds):,.0f} frames a second of "
        f"the processor ({len(grid.weights.indptr) - 1:,} vertices, {len(grid.triangles):,} triangles); 60 are wanted"
    )
