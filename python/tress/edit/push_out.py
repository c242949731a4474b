"""No strip may enter the head."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.base.report import Report
from tress.edit.move_points import moved
from tress.edit.pushing import pushed
from tress.edit.selection import editable_strips
from tress.edit.surface_distance import DENSITY, ON_SURFACE_M, distances, skin
from tress.model.attachment import surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.strip_grid import strip_grid
from tress.model.strip_set import resting_points, strip_set

Array = np.ndarray[Any, Any]

OVERSHOOT = 1.02  # pushing a little further settles sooner


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

    Measured at rest, at twice the density at which strips are shown; the clearance is for what lies between. The report
    gets `strips_inside`, `deepest_m` and `strips_moved`, and a warning where the rounds did not suffice. `clearances`
    measures without moving, at any time. Raises `InputError` where the surface is no closed `Head` or `Mesh`, a
    name is no strip or group, or a strip is locked.
    """
    if not 0 <= clearance_m < np.inf or max_iterations < 1:
        raise InputError(f"A clearance of {clearance_m} m in {max_iterations} rounds; 0 or more, and 1, were expected.")
    report = report or Report()
    mesh = skin(surface_mesh(document, surface, where="A strip"))
    strips = strip_set(document, list(editable_strips(document, names)))
    if not strips.names:
        return Diff()
    before = resting_points(strips)
    grid = strip_grid(strips.records, density=DENSITY)
    deepest = np.full(len(strips.names), np.inf)

    def demand(points: Array, rows: Array) -> Array:
        distance, outwards = distances(mesh, points)
        if len(rows) == len(grid.strip) and np.isinf(deepest).all():
            np.minimum.at(deepest, grid.strip, distance)
        missing = np.where(distance < clearance_m, OVERSHOOT * (clearance_m - distance) + ON_SURFACE_M, 0.0)
        return missing[:, None] * outwards

    found = pushed(grid, before, demand, max_iterations=max_iterations)
    diff = moved(strips, found.control_points - before)
    report.number("strips_inside", int((deepest < 0).sum()))
    report.number("deepest_m", float(max(0.0, -deepest.min())))
    report.number("strips_moved", len(diff.updated))
    if not found.converged:
        report.warn(f"Some strips are nearer to {surface!r} than {clearance_m} m after {max_iterations} rounds.")
    return diff
