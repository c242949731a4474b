"""Layers of strips: outer ones pushed off inner ones."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.base.report import Report
from tress.edit.move_points import moved
from tress.edit.pushing import pushed
from tress.edit.selection import editable_strips
from tress.edit.surface_distance import DENSITY, distances, skin
from tress.kernel.geom import ray_hits
from tress.model.attachment import surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.strip_grid import strip_grid
from tress.model.strip_set import resting_points, strip_set
from tress.model.strips import strip_names

Array = np.ndarray[Any, Any]

OVERSHOOT = 1.02
TOLERANCE_M = 1e-6


def layer(
    document: Document,
    *,
    outer: Iterable[str],
    inner: Iterable[str],
    surface: str,
    gap_m: float = 0.001,
    within_m: float = 0.03,
    max_iterations: int = 40,
    report: Report | None = None,
) -> Diff:
    """Pushes the outer strips off the inner ones: wherever an inner strip lies less than `gap_m` beneath a sample of an
    outer one, or up to `within_m` above it, on the line straight out of the surface, the sample comes to lie `gap_m`
    above it.

    Roots are held: the first row of control points does not move, nor what hangs on it. The report gets `strips_moved`,
    and a warning where the rounds did not suffice. Raises `InputError` where a name is no strip or group, a strip is in
    both layers, or an outer one is locked.
    """
    if not (0 <= gap_m < np.inf and 0 < within_m < np.inf) or max_iterations < 1:
        raise InputError(f"A gap of {gap_m} m within {within_m} m in {max_iterations} rounds is none.")
    report = report or Report()
    mesh = skin(surface_mesh(document, surface, where="A strip"))
    strips = strip_set(document, list(editable_strips(document, outer)))
    below = strip_set(document, strip_names(document, inner))
    if both := set(strips.names) & set(below.names):
        raise InputError(f"Strip {min(both)!r} is in both layers; one was expected.")
    if not strips.names or not below.names:
        return Diff()
    under = strip_grid(below.records)
    under_points = under.points(resting_points(below))
    held = _root_rows(strips.shapes, strips.offsets)

    def demand(points: Array, _: Array) -> tuple[Array, Array]:
        _, outwards = distances(mesh, points)
        hits = ray_hits(
            under_points,
            triangles=under.triangles,
            origins=points + within_m * outwards,
            directions=-outwards,
            limit=within_m + gap_m,
        )
        short = np.where(hits.triangle >= 0, within_m + gap_m - hits.t, 0.0)  # of the gap above the inner layer
        return np.where(short > TOLERANCE_M, OVERSHOOT * short, 0.0)[:, None] * outwards, np.zeros(len(points))

    before, grid = resting_points(strips), strip_grid(strips.records, density=DENSITY)
    found = pushed(grid, before, demand, max_iterations=max_iterations, held=held)
    diff = moved(strips, found.control_points - before)
    report.number("strips_moved", len(diff.updated))
    if not found.converged:
        report.warn(f"Some strips are nearer than {gap_m} m to the layer beneath after {max_iterations} rounds.")
    return diff


def _root_rows(shapes: Array, offsets: Array) -> Array:
    """(N,) whether a control point is in the first row of its strip."""
    held = np.zeros(offsets[-1], bool)
    for (_, columns), start in zip(shapes, offsets[:-1], strict=True):
        held[start : start + columns] = True
    return held
