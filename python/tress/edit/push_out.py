"""No strip may enter the head."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.base.report import Report
from tress.edit.move_points import moved
from tress.edit.pushing import pushed
from tress.edit.selection import editable_strips
from tress.edit.surface_distance import DENSITY, FINE_DENSITY, ON_SURFACE_M, distances, skin
from tress.model.attachment import surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.strip_grid import StripGrid, strip_grid
from tress.model.strip_set import resting_points, strip_set

Array = np.ndarray[Any, Any]

OVERSHOOT = 1.02  # pushing a little further settles sooner
LONGEST_STEP_M = 0.01  # of a round, so that neighbours go the same way
MOST_SLACK_M = 0.02  # beyond, a hole of the surface may be near, where distances jump in sign


def push_out(
    document: Document,
    *,
    names: Iterable[str],
    surface: str,
    clearance_m: float = 0.001,
    max_iterations: int = 60,
    report: Report | None = None,
) -> Diff:
    """Moves control points of strips outwards until every sample of them is `clearance_m` or more outside a surface.

    Measured at rest, at twice and then at five times the density at which strips are shown; the clearance is for what
    lies between. The report gets `strips_inside`, `deepest_m` and `strips_moved`, and a warning where the rounds did
    not suffice. `clearances` measures without moving, at any time. A strip that runs through the middle of a head comes
    out crumpled, or not at all: lift it first. Raises `InputError` where the surface is no `Head` or `Mesh`, a name is
    no strip or group, or a strip is locked.
    """
    if not 0 <= clearance_m < np.inf or max_iterations < 1:
        raise InputError(f"A clearance of {clearance_m} m in {max_iterations} rounds; 0 or more, and 1, were expected.")
    report = report or Report()
    mesh = skin(surface_mesh(document, surface, where="A strip"))
    strips = strip_set(document, list(editable_strips(document, names)))
    if not strips.names:
        return Diff()

    def demand(points: Array, _: Array) -> tuple[Array, Array]:
        distance, outwards = distances(mesh, points)
        missing = OVERSHOOT * (clearance_m - distance) + ON_SURFACE_M
        wanted = np.where(distance < clearance_m, np.minimum(missing, LONGEST_STEP_M), 0.0)[:, None] * outwards
        return wanted, np.clip(distance - clearance_m, 0, MOST_SLACK_M)

    before = resting_points(strips)
    coarse, fine = (strip_grid(strips.records, density=density) for density in (DENSITY, FINE_DENSITY))
    distance = distances(mesh, coarse.points(before))[0]
    found = pushed(
        coarse, before, demand, max_iterations=max_iterations, slack=np.minimum(distance - clearance_m, MOST_SLACK_M)
    )
    slack = _slack_between(coarse, fine, found.control_points, found.slack)
    found = pushed(fine, found.control_points, demand, max_iterations=max_iterations, slack=slack)
    least = np.full(len(strips.names), np.inf)
    np.minimum.at(least, coarse.strip, distance)
    diff = moved(strips, found.control_points - before)
    report.number("strips_inside", int((least < 0).sum()))
    report.number("deepest_m", float(max(0.0, -least.min())))
    report.number("strips_moved", len(diff.updated))
    if not found.converged:
        report.warn(f"Some strips are nearer to {surface!r} than {clearance_m} m after {max_iterations} rounds.")
    return diff


def _slack_between(coarse: StripGrid, fine: StripGrid, control_points: Array, slack: Array) -> Array:
    """How far the points of a finer grid may move at least: distances grow no faster than the way from the nearest
    point of the coarser grid."""
    nearest = np.concatenate(
        [
            start + _nearest_on_grid(coarse.fraction[start:stop], fine.fraction[first:last])
            for start, stop, first, last in zip(
                coarse.offsets[:-1], coarse.offsets[1:], fine.offsets[:-1], fine.offsets[1:], strict=True
            )
        ]
    )
    way = fine.points(control_points) - coarse.points(control_points)[nearest]
    return slack[nearest] - np.linalg.norm(way, axis=1)


def _nearest_on_grid(coarse: Array, fine: Array) -> Array:
    """(Q,) for every point of a grid the nearest one of a coarser grid, both given by their fractions (Q, 2)."""
    columns = int(np.count_nonzero(coarse[:, 0] == coarse[0, 0]))
    lines = [coarse[::columns, 0], coarse[:columns, 1]]
    row, column = (np.searchsorted((line[1:] + line[:-1]) / 2, fine[:, axis]) for axis, line in enumerate(lines))
    return row * columns + column
