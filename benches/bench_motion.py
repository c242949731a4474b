"""A hairdo in motion: how many times a second its strips are posed and meshed, on one core."""

import os
import statistics
import subprocess
import sys
import time

import numpy as np
from rich.console import Console

from tress.methods.strips.motions import MotionParams, motion_of
from tress.model.document import Document
from tress.model.strip_grid import strip_grid
from tress.model.strip_set import StripSet, posed_points, strip_set
from tress.model.strip_shapes import flat_strip

STRIPS, FRAMES = 300, 60


def moving_strips() -> StripSet:
    """Strips of 30 cm side by side, each with a wind of its own."""
    flat = flat_strip(length_m=0.3, width_m=0.02)
    shifts = np.random.default_rng(0).uniform(-0.1, 0.1, (STRIPS, 3))
    records = {f"s{i}": flat.transformed(_moved(shift)) for i, shift in enumerate(shifts)}
    names = tuple(records)
    blown = motion_of("wind")(Document(records), targets=names, params=MotionParams())
    return strip_set(Document({**records, **blown}), names)


def _moved(shift: np.ndarray) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = shift
    return matrix


def main() -> None:
    """Runs in a process of its own, which is held to one core."""
    environment = {**os.environ, "RAYON_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    subprocess.run([sys.executable, "-m", "benches.bench_motion"], env=environment, check=True)


if __name__ == "__main__":
    strips = moving_strips()
    grid = strip_grid(strips.records)
    times = np.linspace(0, 2, FRAMES)
    grid.points(posed_points(strips, 0.0))
    seconds = []
    for moment in times:
        start = time.process_time()
        grid.points(posed_points(strips, moment))
        seconds.append(time.process_time() - start)
    found = 1 / statistics.median(seconds)
    Console().print(
        f"{STRIPS} strips, each moved by keyframes of its own: {found:,.0f} frames a second of the processor "
        f"({len(strips.points):,} control points, {len(grid.triangles):,} triangles); 60 are wanted"
    )
