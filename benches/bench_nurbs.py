"""NURBS strips beside openNURBS (rhino3dm) and geomdl: points and tessellated strips a second, on one core."""

import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np
import rhino3dm
from geomdl import NURBS
from rich.console import Console
from rich.table import Table

from tress.kernel.nurbs import Patch, Patches, evaluate, evaluate_grid, patch
from tress.kernel.tessellation import tessellate, tessellate_segments

STRIPS = 2000
CONTROL_POINTS = (8, 4)
SEGMENTS = (16, 6)
ACCURACY_M = 2e-4


def random_strips(count: int = STRIPS) -> list[Patch]:
    """Bicubic strips of 8 x 4 control points, 0.2 m long and 2 cm wide, bent at random, with weights from 1/2 to 2."""
    rng = np.random.default_rng(0)
    along, across = np.meshgrid(np.linspace(0, 0.2, 8), np.linspace(-0.01, 0.01, 4), indexing="ij")
    flat = np.stack([across, -along, np.zeros_like(along)], axis=-1)
    bends = np.cumsum(rng.normal(0, 0.01, (count, 8, 1, 3)), axis=1)
    points = flat + bends + rng.normal(0, 0.001, (count, 8, 4, 3))
    weights = 2.0 ** rng.uniform(-1, 1, (count, *CONTROL_POINTS))
    return [patch(p, weights=w) for p, w in zip(points, weights, strict=True)]


def rhino_strip(strip: Patch) -> rhino3dm.NurbsSurface:
    """The strip in openNURBS, which wants homogeneous points and neither the first nor the last knot."""
    made = rhino3dm.NurbsSurface.Create(3, True, 4, 4, *CONTROL_POINTS)
    for i in range(CONTROL_POINTS[0]):
        for j in range(CONTROL_POINTS[1]):
            weight = strip.weights[i, j]
            made.Points[(i, j)] = rhino3dm.Point4d(*strip.points[i, j] * weight, weight)
    for vector, knots in ((made.KnotsU, strip.knots_u), (made.KnotsV, strip.knots_v)):
        for i, knot in enumerate(knots[1:-1]):
            vector[i] = knot
    return made


def geomdl_strip(strip: Patch) -> NURBS.Surface:
    """The strip in geomdl, sampled where ours is."""
    made = NURBS.Surface()
    made.degree_u = made.degree_v = 3
    made.set_ctrlpts(
        np.concatenate([strip.points * strip.weights[..., None], strip.weights[..., None]], axis=-1)
        .reshape(-1, 4)
        .tolist(),
        *CONTROL_POINTS,
    )
    made.knotvector_u, made.knotvector_v = strip.knots_u.tolist(), strip.knots_v.tolist()
    made.sample_size_u, made.sample_size_v = SEGMENTS[0] + 1, SEGMENTS[1] + 1
    return made


def rate(work: Callable[[], object], done: int, *, repeats: int = 5) -> float:
    """How many of `done` things a second: the median of some runs after a first one."""
    work()
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - start)
    return done / statistics.median(seconds)


def rates() -> tuple[dict[str, float], dict[str, float]]:
    """Points evaluated and strips tessellated a second, by what did it."""
    strips = random_strips()
    batch = Patches.of(strips)
    u, v = np.linspace(0, 1, SEGMENTS[0] + 1), np.linspace(0, 1, SEGMENTS[1] + 1)
    pairs = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1).reshape(-1, 2)
    everywhere = np.tile(pairs, (STRIPS, 1))
    index = np.repeat(np.arange(STRIPS), len(pairs))
    rhino = [rhino_strip(s) for s in strips[:20]]
    theirs = [geomdl_strip(s) for s in strips[:4]]
    uv = [tuple(pair) for pair in pairs.tolist()]
    points = {
        "tress, grids": rate(lambda: evaluate_grid(batch, u=u, v=v), len(index)),
        "tress, any points": rate(lambda: evaluate(batch, uv=everywhere, index=index), len(index)),
        "rhino3dm": rate(lambda: [s.PointAt(a, b) for s in rhino for a, b in uv], len(rhino) * len(uv)),
        "geomdl": rate(lambda: [s.evaluate_list(uv) for s in theirs], len(theirs) * len(uv), repeats=3),
    }
    tessellated = {
        f"tress, {SEGMENTS[0]} x {SEGMENTS[1]}": rate(lambda: tessellate_segments(batch, segments=SEGMENTS), STRIPS),
        f"tress, within {ACCURACY_M * 1e3} mm": rate(lambda: tessellate(batch, accuracy=ACCURACY_M), STRIPS, repeats=3),
        "rhino3dm, points and normals": rate(
            lambda: [(s.PointAt(a, b), s.NormalAt(a, b)) for s in rhino for a, b in uv], len(rhino)
        ),
        "geomdl": rate(lambda: [(s.reset(evalpts=True), s.tessellate()) for s in theirs], len(theirs), repeats=3),
    }
    return points, tessellated


def table(title: str, found: dict[str, float]) -> Table:
    """Rates, and how many times that of rhino3dm each is."""
    made = Table(title=title)
    made.add_column("")
    made.add_column("a second", justify="right")
    made.add_column("times rhino3dm", justify="right")
    reference = next(value for name, value in found.items() if name.startswith("rhino3dm"))
    for name, value in found.items():
        made.add_row(name, f"{value:,.0f}", f"{value / reference:.2f}")
    return made


def main() -> None:
    """Runs in a process of its own, which is held to one core."""
    environment = {**os.environ, "RAYON_NUM_THREADS": "1"}
    subprocess.run([sys.executable, "-m", "benches.bench_nurbs"], env=environment, check=True)


if __name__ == "__main__":
    console = Console(width=120)
    evaluated, meshed = rates()
    console.print(table(f"{STRIPS} bicubic strips of 8 x 4 control points: points evaluated, one core", evaluated))
    console.print(table("Strips tessellated, one core", meshed))
    mesh = tessellate(Patches.of(random_strips()), accuracy=ACCURACY_M)
    console.print(f"within {ACCURACY_M * 1e3} mm: {mesh.polygons.mean():.1f} polygons a strip")
