"""`make bench`: the time and memory of every stage of the main job, and each kernel beside a public reference."""

import resource
import sys
import time
from collections.abc import Callable

import cv2
import numpy as np
from rich.console import Console
from rich.table import Table
from skimage import data

from benches import (
    bench_clumps,
    bench_depth,
    bench_formats,
    bench_gabor,
    bench_matte,
    bench_motion,
    bench_nurbs,
    bench_raster,
)
from tress.base.report import Report
from tress.methods.portrait.pipeline import reconstruct

CONSOLE = Console(width=120)
RUNS = 3
HEAD_BOX = (slice(0, 250), slice(95, 345))
"""The astronaut's head and shoulders; enlarged four times, her hair fills some 500 x 440 pixels."""


def portrait_photo() -> np.ndarray:
    """(1000, 1000, 3) uint8 sRGB: a public-domain portrait with a hair region of about 500 x 500 pixels."""
    return cv2.resize(data.astronaut()[HEAD_BOX], None, fx=4, fy=4, interpolation=cv2.INTER_CUBIC)


def bench_portrait() -> None:
    """Seconds of every stage, photograph in memory to a document of 50,000 coloured strands: the best of some runs.

    A first run warms up and does not count. Other work on the machine shows in the seconds of the clock far more than
    in those of the processor; on two idle cores, the clock should need a good half of the processor's.
    """
    photo = portrait_photo()
    reconstruct(photo)
    best: dict[str, float] = {}
    processor_secs = float("inf")
    for _ in range(RUNS):
        report, before = Report(), time.process_time()
        reconstruct(photo, report=report)
        processor_secs = min(processor_secs, time.process_time() - before)
        for stage in report.stages:
            best[stage.name] = min(best.get(stage.name, float("inf")), stage.duration_secs)
    table = Table(title=f"Portrait of 1000 x 1000 px: seconds a stage, the best of {RUNS} runs")
    table.add_column("stage")
    table.add_column("seconds", justify="right")
    for name, seconds in best.items():
        table.add_row(name, f"{seconds:.2f}")
    table.add_row("all", f"{sum(best.values()):.2f}", style="bold")
    table.add_row("processor, all cores", f"{processor_secs:.2f}")
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
    "motion": bench_motion.main,
    "clumps": bench_clumps.main,
}

if __name__ == "__main__":
    for name in sys.argv[1:] or BENCHES:
        CONSOLE.rule(name)
        BENCHES[name]()
