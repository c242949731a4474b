"""The statistical head as its landmarks know it, with everything that a fit can reuse.

The normal matrix of the shape's least squares is a sum over landmarks of B_i M B_i^T, where only the 3 x 3 matrix M
depends on the pose. So the sums over landmarks are made once for each set of weights, and a round of the fit is left
with nine scaled additions. Sums run through `einsum` and not through BLAS: its threads would change the last bits with
their number.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from tress.head.landmarks import COUNT, FACE_OVAL
from tress.head.statistical import StatisticalHead


@dataclass(frozen=True, eq=False)
class LandmarkBasis:
    """`rest` (468, 3) metres; `basis` (K + E, 3, 468) metres: shape first, then expressions; `shape_count` is K."""

    rest: NDArray[np.float64]
    basis: NDArray[np.float64]
    shape_count: int

    def points(self, coefficients: NDArray[np.float64]) -> NDArray[np.float64]:
        """The landmarks (468, 3) of the head with these coefficients (K + E,), metres."""
        return self.rest + np.einsum("k,kdn->nd", coefficients, self.basis)

    def products(self, weight: NDArray[np.float64]) -> NDArray[np.float64]:
        """Weighted sums over the landmarks of products of two basis vectors' coordinates (3, 3, K + E, K + E)."""
        count = len(self.basis)
        out = np.empty((3, 3, count, count))
        for a in range(3):
            for b in range(a, 3):
                out[a, b] = np.einsum("kn,ln->kl", self.basis[:, a] * weight, np.ascontiguousarray(self.basis[:, b]))
                out[b, a] = out[a, b].T
        return out


@lru_cache(maxsize=4)
def landmark_basis(head: StatisticalHead) -> LandmarkBasis:
    """The basis of `head`; kept."""
    components = [head.shape_components, head.expression_components]
    basis = np.concatenate([head.at_landmarks(part) for part in components])
    shaped = np.ascontiguousarray(np.swapaxes(basis, 1, 2))
    return LandmarkBasis(head.at_landmarks(head.mean), shaped, len(head.shape_components))


@lru_cache(maxsize=8)
def side_products(head: StatisticalHead, side: int) -> NDArray[np.float64]:
    """`products` with the weights of `near_side(side)`; kept, about 0.1 s each the first time."""
    return landmark_basis(head).products(near_side(side))


def near_side(side: int) -> NDArray[np.float64]:
    """Weights (468,): 0 for the outline's points on the far side of a head turned to its left (1) or right (-1)."""
    weight = np.ones(COUNT)
    half = len(FACE_OVAL) // 2
    if side > 0:
        weight[list(FACE_OVAL[1:half])] = 0
    elif side < 0:
        weight[list(FACE_OVAL[half + 1 :])] = 0
    return weight
