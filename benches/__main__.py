"""`make bench`: the time and memory of every stage of the main job, and each kernel beside a public reference."""

import resource
import sys
from collections.abc import Callable

import cv2
import numpy as np
from rich.console import Console
from rich.table import Table
from skimage import data

from benches import bench_depth, bench_formats, bench_gabor, bench_matte, bench_nurbs, bench_raster
from tress.base.report import Report
from tress.methods.portrait.pipeline import reconstruct

CONSOLE = Console(width=120)
HEAD_BOX = (slice(0, 250), slice(95, 345))
"""The astronaut's head and shoulders; enlarged four times, her hair fills some 500 x 440 pixels."""


def portrait_photo() -> np.ndarray:
    """(1000, 1000, 3) uint8 sRGB: a public-domain portrait with a hair region of about 500 x 500 pixels."""
    return cv2.resize(data.astronaut()[HEAD_BOX], None, fx=4, fy=4, interpolation=cv2.INTER_CUBIC)


def bench_portrait() -> None:
    """Seconds of every stage, photograph in memory to 50,000 coloured strands, on a second run in this process."""
    photo = portrait_photo()
    reconstruct(photo)
    report = Report()
    reconstruct(photo, report=report)
    table = Table(title="Portrait of 1000 x 1000 px: seconds a stage")
    table.add_column("stage")
    table.add_column("seconds", justify="right")
    for stage in report.stages:
        table.add_row(stage.name, f"{stage.duration_secs:.2f}")
    total = sum(stage.duration_secs for stage in report.stages)
    table.add_row("all", f"{total:.2f}", style="bold")
    CONSOLE.print(table)
    peak_gib = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    CONSOLE.print(f"peak memory of the process: {peak_gib:.2f} GiB\n")


BENCHES: dict[str, Callable[[], None]] = {
    "portrait": bench_portrait,
    "gabor": bench_gabor.main,
    "matte": bench_matte.main,
    "depth": bench_depth.main,
    "raster": bench_raster.main,
    "formats": bench_formats.main,
    "nurbs": bench_nurbs.main,
}

if __name__ == "__main__":
    for name in sys.argv[1:] or BENCHES:
        CONSOLE.rule(name)
        BENCHES[name]()
