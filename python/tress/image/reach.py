"""How hard it is to get from a layer's sure places to every other, walking over what looks like it.

Hair grows out of the head: a dark coat below dark hair is only hair if hair leads to it. A shortest path over the
superpixels says so, where a graph cut alone would join what merely looks alike.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

_STEP = 1e-9


def reach(
    toll: NDArray[np.float64],
    *,
    edges: NDArray[np.int32],
    start: NDArray[np.bool_],
    step: NDArray[np.float64] | float = 0.0,
) -> NDArray[np.float64]:
    """Least sum of tolls (N,) on a way from any node of `start` (N,) to every node, the node's own toll included.

    `toll` (N,) >= 0 is paid on entering a node, `step` (E,) >= 0 on crossing an edge; starting is free. Infinite where
    no way leads.

    Each step costs 1e-9 more, because a sparse graph has no edge of length 0.

    >>> start = np.array([True, False, False])
    >>> reach(np.array([0.0, 2.0, 3.0]), edges=np.array([[0, 1], [1, 2]]), start=start).round(6).tolist()
    [0.0, 2.0, 5.0]
    """
    count = len(toll)
    if not start.any():
        return np.full(count, np.inf)
    origin = np.flatnonzero(start)
    rows = np.concatenate([edges[:, 0], edges[:, 1], np.full(len(origin), count)])
    columns = np.concatenate([edges[:, 1], edges[:, 0], origin])
    entering = toll[columns] + _STEP
    entering[: 2 * len(edges)] += np.tile(np.broadcast_to(step, len(edges)), 2)
    entering[2 * len(edges) :] = _STEP
    graph = csr_matrix((entering, (rows, columns)), shape=(count + 1, count + 1))
    return dijkstra(graph, indices=count)[:count]
