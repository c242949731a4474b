"""Cuts the head off MakeHuman's body: along the lowest closed edge loop of the neck (by height it would come out
jagged).

An edge loop goes straight on at every vertex with four edges. The head is what hangs together with the crown above the
loop; eye sockets and mouth bag are closed pockets of the same skin, so the neck is its only boundary. The two eyeballs,
closed meshes of their own, are added after it.
"""

from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tools.assets.makehuman import BaseMesh

LOWEST_M = 0.52
"""No neck loop is sought below this height of the base mesh: there the shoulders begin."""
EYEBALLS = ("helper-l-eye", "helper-r-eye")
SHARED_EDGES = 4

Edge = tuple[int, int]


@dataclass(frozen=True)
class HeadCut:
    """The head's part of the base mesh.

    `vertices` (V,): indices into the base mesh, skin first; `skin_count`: how many are skin. `quads` (Q, 4): indices
    into `vertices`; `corner_uv` (Q, 4): uv indices of the base mesh.
    """

    vertices: NDArray[np.int64]
    skin_count: int
    quads: NDArray[np.int64]
    corner_uv: NDArray[np.int64]


def cut_head(mesh: BaseMesh) -> HeadCut:
    """The head and neck of `mesh` with its eyeballs."""
    body = mesh.quads["body"]
    skin = body[_above(body[..., 0], _neck_loop(mesh), seed=int(np.argmax(_crown_height(mesh))))]
    skin_vertices = np.unique(skin[..., 0])
    faces = np.concatenate([skin, *(mesh.quads[name] for name in EYEBALLS)])
    eye_vertices = np.unique(np.concatenate([mesh.quads[name] for name in EYEBALLS])[..., 0])
    vertices = np.concatenate([skin_vertices, eye_vertices])
    local = np.full(len(mesh.positions), -1)
    local[vertices] = np.arange(len(vertices))
    return HeadCut(vertices, len(skin_vertices), local[faces[..., 0]], faces[..., 1])


def _crown_height(mesh: BaseMesh) -> NDArray[np.float64]:
    return mesh.positions[mesh.quads["body"][..., 0], 1].mean(axis=1)


def _neck_loop(mesh: BaseMesh) -> list[int]:
    """The lowest closed loop around the neck: level by level from its front, among edges left of the middle."""
    quads = mesh.quads["body"][..., 0]
    walk = _LoopWalk(quads)
    height = mesh.positions[:, 1]
    middle = np.abs(mesh.positions[:, 0]) < 0.1
    starts = sorted(edge for edge in walk.faces if middle[list(edge)].all() and min(height[list(edge)]) > LOWEST_M)
    loops = {frozenset(loop): loop for loop in map(walk.loop, starts) if loop and _goes_round(mesh.positions[loop])}
    return min(loops.values(), key=lambda loop: float(height[loop].mean()))


def _goes_round(points: NDArray[np.float64]) -> bool:
    """Whether a loop encloses the neck: both sides, front and back, and level within 7 cm."""
    low, high = points.min(axis=0), points.max(axis=0)
    return bool(low[0] < -0.04 and high[0] > 0.04 and high[2] - low[2] > 0.08 and high[1] - low[1] < 0.07)


class _LoopWalk:
    """Edges of a quad mesh with the faces on either side, walked straight on."""

    def __init__(self, quads: NDArray[np.int64]) -> None:
        self.faces: dict[Edge, list[int]] = defaultdict(list)
        self._neighbours: dict[int, set[int]] = defaultdict(set)
        for face, quad in enumerate(quads.tolist()):
            for a, b in zip(quad, quad[1:] + quad[:1], strict=True):
                self.faces[_edge(a, b)].append(face)
                self._neighbours[a].add(b)
                self._neighbours[b].add(a)

    def loop(self, edge: Edge) -> list[int] | None:
        """The closed loop through `edge`, or None where it ends at a vertex without four edges."""
        walked = list(edge)
        while len(walked) < 200:
            ahead = self._straight_on(walked[-2], walked[-1])
            if ahead is None or ahead == walked[0]:
                return None if ahead is None else walked
            walked.append(ahead)
        return None

    def _straight_on(self, before: int, here: int) -> int | None:
        if len(self._neighbours[here]) != SHARED_EDGES:
            return None
        beside = set(self.faces[_edge(before, here)])
        ahead = [to for to in self._neighbours[here] if not beside & set(self.faces[_edge(here, to)])]
        return ahead[0] if len(ahead) == 1 else None


def _edge(a: int, b: int) -> Edge:
    return (a, b) if a < b else (b, a)


def _above(quads: NDArray[np.int64], loop: list[int], *, seed: int) -> NDArray[np.int64]:
    """The faces (N,) that hang together with the face `seed` without crossing `loop`, ascending."""
    walls = {_edge(a, b) for a, b in zip(loop, loop[1:] + loop[:1], strict=True)}
    faces = _LoopWalk(quads).faces
    listed = quads.tolist()
    seen, waiting = {seed}, [seed]
    while waiting:
        quad = listed[waiting.pop()]
        edges = {_edge(a, b) for a, b in zip(quad, quad[1:] + quad[:1], strict=True)} - walls
        fresh = {face for edge in edges for face in faces[edge]} - seen
        seen |= fresh
        waiting += fresh
    return np.array(sorted(seen))
