"""The statistical head: a mean, 100 directions in which heads differ, 38 in which faces move, and names for its parts.

It is built by `make assets` from MakeHuman's morph targets (CC0). It models artists' heads, not scans: its spread is
plausible, not measured, and its size is that of an average grown-up.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tress.head.assets import asset

REGIONS = ("scalp", "face", "ears", "lips", "eyes", "neck", "inside")


@dataclass(frozen=True, eq=False)
class StatisticalHead:
    """A family of heads in the head frame: metres, facing +z, y up, origin the mean head's centre.

    `mean` (V, 3) float64; `shape_components` (K, V, 3) float32, metres for one standard deviation;
    `expression_components` (E, V, 3) float32, metres for the whole expression, named by `expression_names`.
    `triangles` (F, 3) int32, counter- clockwise from outside; `corner_uv` (F, 3, 2) float32 in [0, 1], v up. `masks`
    by name (V,) float32 in [0, 1]: scalp, face, ears, lips, eyes, neck, inside (mouth bag and eye sockets). The first
    `skin_count` vertices are skin, the rest eyeballs. `mirror` (V,) int32: every vertex's counterpart left and right.
    `extremes` (4,) int32: the vertices of crown, chin, forehead, occiput. `landmark_triangle` (468,) int32 and
    `landmark_barycentric` (468, 3): where the landmarks lie; `landmark_mirror` (468,) pairs them; `landmark_depth`
    (2,) corrects the depth that the network tells (see `fit`).
    """

    mean: NDArray[np.float64]
    shape_components: NDArray[np.float32]
    expression_components: NDArray[np.float32]
    expression_names: tuple[str, ...]
    triangles: NDArray[np.int32]
    corner_uv: NDArray[np.float32]
    masks: Mapping[str, NDArray[np.float32]]
    skin_count: int
    mirror: NDArray[np.int32]
    extremes: NDArray[np.int32]
    landmark_triangle: NDArray[np.int32]
    landmark_barycentric: NDArray[np.float64]
    landmark_mirror: NDArray[np.int32]
    landmark_depth: NDArray[np.float64]

    def positions(
        self, *, shape: NDArray[np.floating] | None = None, expression: NDArray[np.floating] | None = None
    ) -> NDArray[np.float64]:
        """Vertices (V, 3) of one head, metres: `shape` in standard deviations, `expression` in [0, 1] by rights."""
        positions = self.mean
        if shape is not None:
            positions = positions + _combined(shape, self.shape_components)
        if expression is not None:
            positions = positions + _combined(expression, self.expression_components)
        return positions

    def center(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """The centre (3,) of an upright head: half-way chin to crown, between the eyes, middle of the skull's depth."""
        crown, chin, forehead, occiput = positions[self.extremes]
        eyes = positions[self.skin_count :, 0].mean()
        return np.array([eyes, (crown[1] + chin[1]) / 2, (forehead[2] + occiput[2]) / 2])

    def eyes(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Centres (2, 3) of the person's right and left eyeball."""
        balls = np.arange(self.skin_count, len(self.mean))
        right = self.mean[balls, 0] < 0
        return np.stack([positions[balls[right]].mean(axis=0), positions[balls[~right]].mean(axis=0)])

    def at_landmarks(self, values: NDArray) -> NDArray[np.float64]:
        """Anything given at the vertices (..., V, C), at the 468 landmarks (..., 468, C)."""
        corners = values[..., self.triangles[self.landmark_triangle], :]
        return np.einsum("nk,...nkc->...nc", self.landmark_barycentric, corners)


def _combined(coefficients: NDArray[np.floating], components: NDArray[np.float32]) -> NDArray[np.float32]:
    """The weighted sum (V, 3), with the same bits for any number of threads."""
    return np.einsum("k,kvd->vd", np.asarray(coefficients, np.float32), components[: len(coefficients)])


@cache
def load_statistical_head(path: Path | None = None) -> StatisticalHead:
    """The built head, or another file of the same form; kept after the first call (0.1 s).

    Raises `AssetMissingError` where it has not been built.
    """
    with np.load(path or asset("head.npz")) as file:
        head = StatisticalHead(
            mean=file["mean"].astype(np.float64),
            shape_components=file["shape_components_mm"].astype(np.float32) * np.float32(1e-3),
            expression_components=file["expression_components_mm"].astype(np.float32) * np.float32(1e-3),
            expression_names=tuple(str(name) for name in file["expression_names"]),
            triangles=file["triangles"],
            corner_uv=file["corner_uv"],
            masks={name: file[f"mask_{name}"] for name in REGIONS},
            skin_count=int(file["skin_count"]),
            mirror=file["mirror"],
            extremes=file["extremes"],
            landmark_triangle=file["landmark_triangle"],
            landmark_barycentric=file["landmark_barycentric"].astype(np.float64),
            landmark_mirror=file["landmark_mirror"],
            landmark_depth=file["landmark_depth"],
        )
    for value in (*vars(head).values(), *head.masks.values()):
        if isinstance(value, np.ndarray):
            value.setflags(write=False)
    return head
