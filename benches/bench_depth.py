"""Depth of strands against SciPy's biconjugate gradients, the paper's solver (`python -m benches.bench_depth`).

Both solve the same normal equations of eq. 5 to the same relative residual, SciPy with its matrix already assembled.
"""

import time
from collections.abc import Callable

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array
from scipy.sparse.linalg import bicg

from tress.kernel import fields

STRANDS, POINTS, WIDTH = 3000, 30, 500
ACCURACY = 1e-5


def strands(*, seed: int = 0) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Points (N, 2), offsets, known depths and weights of wavy strands that hang over 500 x 500 px."""
    random = np.random.default_rng(seed)
    start = random.uniform(0, WIDTH, (STRANDS, 1, 2))
    down = np.arange(POINTS) * 2.25
    sway = 6 * np.sin(down / 40 + start[..., 0] / 80)
    points = (start + np.stack([sway, np.broadcast_to(down, sway.shape)], axis=-1)).reshape(-1, 2)
    target = 0.05 * np.sqrt(np.clip(1 - ((points[:, 0] - WIDTH / 2) / (WIDTH / 2)) ** 2, 0, 1))
    weight = np.where(np.abs(points[:, 0] - WIDTH / 2) > 0.45 * WIDTH, 5.0, 0.05)
    return points, np.arange(STRANDS + 1) * POINTS, target, weight


def normal_matrix(offsets: np.ndarray, near: fields.Neighbours, weight: np.ndarray) -> csr_array:
    """W_Z + 2 Sᵀ S + Nᵀ N."""
    count = len(weight)
    inner = np.setdiff1d(np.arange(count), np.r_[offsets[:-1], offsets[1:] - 1])
    one, half = np.ones(len(inner)), np.full(len(inner), -0.5)
    entries = np.r_[one, half, half], (np.r_[inner, inner, inner], np.r_[inner, inner - 1, inner + 1])
    bend = coo_array(entries, shape=(count, count)).tocsr()
    lengths = np.diff(near.starts)
    row = np.repeat(np.arange(count), lengths)
    some = np.nonzero(lengths)[0]
    data = np.r_[np.ones(len(some)), -1 / lengths[row]], (np.r_[some, row], np.r_[some, near.members.astype(np.int64)])
    stray = coo_array(data, shape=(count, count)).tocsr()
    return csr_array(diags_array(weight) + 2 * bend.T @ bend + stray.T @ stray)


def best_of(times: int, work: Callable[[], object]) -> float:
    """Least seconds of several runs."""
    spent = []
    for _ in range(times):
        begin = time.perf_counter()
        work()
        spent.append(time.perf_counter() - begin)
    return min(spent)


def main() -> None:
    """Prints the seconds of both, their ratio and how far their answers are apart."""
    points, offsets, target, weight = strands()
    near = fields.neighbours(points, offsets=offsets, occluded=np.zeros(len(points), bool), radius=5.0, max_angle=0.35)
    matrix = normal_matrix(offsets, near, weight)
    zero = np.zeros(len(points))

    def ours() -> fields.Depths:
        return fields.strand_depths(target, weight=weight, offsets=offsets, near=near, start=zero, accuracy=ACCURACY)

    def theirs() -> np.ndarray:
        return np.asarray(bicg(matrix, weight * target, x0=zero, rtol=ACCURACY, maxiter=5000)[0])

    mine, other = ours(), theirs()
    ours_secs, theirs_secs = best_of(3, ours), best_of(2, theirs)
    apart = np.abs(mine.z - other).max() * 1000
    print(
        f"depth   {len(points)} vertices: {ours_secs:.3f} s in {mine.iterations} steps (converged: {mine.converged}); "
        f"SciPy bicg {theirs_secs:.3f} s, ratio {theirs_secs / ours_secs:.1f}; apart by {apart:.2f} mm at most"
    )


if __name__ == "__main__":
    main()
