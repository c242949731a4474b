"""No strip may enter the head."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.base.report import Report
from tress.edit.clearances import clearances
from tress.edit.move_points import moved
from tress.edit.pushing import pushed
from tress.edit.selection import editable_strips
from tress.edit.surface_distance import DENSITY, FINE_DENSITY, ON_SURFACE_M, distances, skin
from tress.model.attachment import surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.strip_grid import strip_grid
from tress.model.strip_set import resting_points, strip_set

Array = np.ndarray[Any, Any]

OVERSHOOT = 1.02  # pushing a little further settles sooner
LONGEST_STEP_M = 0.01  # of a round, so that neighbours go the same way


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

    Measured at rest, at twice and then at six times the density at which strips are shown; the clearance is for what
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

    def demand(points: Array, _: Array) -> Array:
        distance, outwards = distances(mesh, points)
        missing = OVERSHOOT * (clearance_m - distance) + ON_SURFACE_M
        return np.where(distance < clearance_m, np.minimum(missing, LONGEST_STEP_M), 0.0)[:, None] * outwards

    before, converged = resting_points(strips), True
    after = before
    for density in (DENSITY, FINE_DENSITY):
        found = pushed(strip_grid(strips.records, density=density), after, demand, max_iterations=max_iterations)
        after, converged = found.control_points, found.converged
    diff = moved(strips, after - before)
    least = np.array(list(clearances(document, names=strips.names, surface=surface).values()))
    report.number("strips_inside", int((least < 0).sum()))
    report.number("deepest_m", float(max(0.0, -least.min())))
    report.number("strips_moved", len(diff.updated))
    if not converged:
        report.warn(f"Some strips are nearer to {surface!r} than {clearance_m} m after {max_iterations} rounds.")
    return diff
