"""Speed of the rasteriser: 50,000 strands of 50 segments to 1000 x 1000 pixels (`python -m benches.bench_raster`)."""

import time

import numpy as np

from tress.kernel import raster

STRANDS = 50_000
POINTS = 51


def groom(*, seed: int = 0) -> np.ndarray:
    """(N, 4) projected points of wavy strands of 500 px, hanging over half of the picture, a hundred deep."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 1, POINTS)
    phase = rng.uniform(0, 6, (STRANDS, 1))
    root_x, root_y, root_z = (rng.uniform(low, high, (STRANDS, 1)) for low, high in ((250, 750), (150, 350), (0, 100)))
    x = root_x + 20 * np.sin(6 * t + 0.2 * phase) + 30 * t * np.sin(phase)
    y = np.broadcast_to(root_y + 500 * t, x.shape)
    z = root_z + 10 * np.sin(5 * t + phase)
    return np.stack([x, y, z, np.ones_like(x)], axis=-1).reshape(-1, 4).astype(np.float32)


def seconds(points: np.ndarray, *, width_px: float, alpha: float) -> tuple[float, float, int]:
    """Best wall-clock and processor time of three runs, and the number of fragments."""
    best, fragments = (np.inf, np.inf), 0
    for _ in range(3):
        wall, cpu = time.perf_counter(), time.process_time()
        found = raster.rasterise(
            points,
            offsets=np.arange(0, len(points) + 1, POINTS),
            half_width_px=np.full(len(points), 0.5 * width_px),
            alpha=np.full(len(points), alpha),
            mesh_vertices=np.zeros((0, 4)),
            triangles=np.zeros((0, 3), np.uint32),
            width=1000,
            height=1000,
        )
        spent = (time.perf_counter() - wall, time.process_time() - cpu)
        best, fragments = (min(best[0], spent[0]), min(best[1], spent[1])), len(found.weight)
    return best[0], best[1], fragments


def main() -> None:
    """Prints one line for each width and opacity."""
    points = groom()
    for width_px, alpha in ((1.0, 1.0), (0.3, 1.0), (1.0, 0.5)):
        wall, cpu, fragments = seconds(points, width_px=width_px, alpha=alpha)
        print(
            f"raster  {STRANDS} strands, {STRANDS * (POINTS - 1)} segments, {width_px} px, alpha {alpha}: "
            f"{wall:.2f} s ({cpu:.2f} s of processor), {fragments} fragments"
        )


if __name__ == "__main__":
    main()
