"""A smooth colour of the skin all over the head, out of what is known at some of its vertices.

The colour minimises the thin sheet's energy on the surface, a weighted distance from what is known, and far from all
of it a distance from one colour: (L + K + S) c = K known + S far, with the cotangent Laplacian L, the trust K and the
screen S in the unit of the mass matrix. It lives on the mesh and not in the texture, so that neither the texture's
seams nor the middle of the head show. Limits: smooth by construction, it holds no pores, wrinkles or moles.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array, diags_array

from tress.head.statistical import StatisticalHead

FAR_M = 0.05
"""Distance over which what is known gives way to the far colour."""
NEAR_M = 0.004
"""Distance within which the field follows what is known surely."""
ACCURACY = 1e-4
MAX_ROUNDS = 500
TINY = 1e-300
LEAST_COTANGENT = 0.02
"""Edges of obtuse triangles count at least so much, which keeps the colours within the range of what is known."""


def skin_field(
    known: NDArray[np.floating], *, trust: NDArray[np.floating], far: NDArray[np.floating], head: StatisticalHead
) -> NDArray[np.float32]:
    """Colours (V, 3) at the vertices of `head`, near `known` (V, 3) where `trust` (V,) in [0, 1] is high, and `far`
    (3,) away from it.

    Every channel stays between the least and the greatest of `known` and `far`, within 0.002. About 15 ms.
    """
    laplacian, area = surface(head)
    hold, screen = area * trust / NEAR_M**2, area / FAR_M**2
    away = np.asarray(known - far, np.float64)
    matrix = csr_array(laplacian + diags_array(hold + screen))
    return (far + _conjugate_gradients(matrix, hold[:, None] * away)).astype(np.float32)


def _conjugate_gradients(matrix: csr_array, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Solves the definite `matrix` (V, V) for the columns of `values` (V, C) at once, to ACCURACY of their size.

    Jacobi's preconditioner; some 60 rounds. A direct solver would fill in the matrix twenty-fold.
    """
    inverse = 1 / matrix.diagonal()[:, None]
    solution = np.zeros_like(values)
    residual = values.copy()
    goal = ACCURACY**2 * _product(values * inverse, values)
    step = residual * inverse
    size = _product(step, residual)
    for _ in range(MAX_ROUNDS):
        if (size <= goal).all():
            break
        pushed = matrix @ step
        length = size / np.maximum(_product(step, pushed), TINY)
        solution += length * step
        residual -= length * pushed
        before, size = size, _product(residual * inverse, residual)
        step = residual * inverse + size / np.maximum(before, TINY) * step
    return solution


def _product(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Column by column, with the same bits for any number of threads."""
    return (a * b).sum(axis=0)


@lru_cache(maxsize=2)
def surface(head: StatisticalHead) -> tuple[csr_array, NDArray[np.float64]]:
    """The cotangent Laplacian (V, V) of the mean head, positive semi-definite, and the area (V,) m² of each vertex."""
    corners = head.mean[head.triangles]
    count = len(head.mean)
    rows, columns, weights = [], [], []
    for k in range(3):
        a, b, c = (corners[:, (k + step) % 3] for step in range(3))
        cross = np.linalg.norm(np.cross(a - c, b - c), axis=1)
        cotangent = np.einsum("fd,fd->f", a - c, b - c) / np.maximum(cross, 1e-12)
        rows.append(head.triangles[:, k])
        columns.append(head.triangles[:, (k + 1) % 3])
        weights.append(np.clip(cotangent / 2, LEAST_COTANGENT, 1 / LEAST_COTANGENT))
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    area = np.bincount(head.triangles.ravel(), weights=np.repeat(doubled / 6, 3), minlength=count)
    row, column, weight = (np.concatenate(part) for part in (rows, columns, weights))
    edges = coo_array((weight, (row, column)), shape=(count, count)).tocsr()
    edges = edges + edges.T
    return csr_array(diags_array(np.asarray(edges.sum(axis=0)).ravel()) - edges), np.maximum(area, 1e-12)
