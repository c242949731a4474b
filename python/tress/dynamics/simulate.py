"""Simulating strips and baking their motion to keyframes."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.base.report import Report
from tress.dynamics.head_motion import HeadMotion, moved, moved_back, still
from tress.dynamics.params import HairParams
from tress.dynamics.strip_chains import StripChains, particles_of, strip_chains
from tress.dynamics.surface_field import SurfaceField, surface_field
from tress.edit.fresh_names import FreshNames
from tress.edit.selection import editable_strips
from tress.kernel.dynamics import Chains, Colliders, DistanceField, DynamicsParams, Particles, advanced
from tress.model.attachment import surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.keyframes import Keyframes
from tress.model.strip_set import StripSet, posed_points, strip_set
from tress.model.strips import strip_names

Array = np.ndarray[Any, Any]


def simulate(
    document: Document,
    *,
    targets: Iterable[str],
    hair: HairParams = HairParams(),
    forces: DynamicsParams = DynamicsParams(),
    surface: str = "",
    head_motion: HeadMotion = still,
    report: Report | None = None,
) -> Diff:
    """Gives every strip within `targets` (strips or groups) keyframes of its simulated motion, instead of those it had.

    What the strips did before, and the head's motion, is what they are drawn to: goals of weight 1 follow it exactly,
    0 hangs free. The keyframes are positions against the head, which itself stands still in the document: move it by
    the same `head_motion` where it is shown. Hair stays out of the record `surface` (a head or mesh), unless it is "".
    The report gets the number of particles, and how far hair was from rest at the end (`last_speed`, metres a second).

    The same bits on any number of cores. Raises `InputError` for a target or surface that is not there, `LockedError`
    for what is locked, `CancelledError` where the report asks to stop: nothing is changed then.
    Source: the particle-spring layer of Modelling and Animating Cartoon Hair, section 3, Dynamics.
    """
    report = report or Report()
    names = tuple(editable_strips(document, targets))
    if not names:
        raise InputError("No strip is left to simulate; name a strip, or a group that holds some.")
    strips = strip_set(document, names)
    with report.stage("surface"):
        field = surface_field(surface_mesh(document, surface, where="A simulation")) if surface else None
    with report.stage("simulate"):
        scene = _Scene(strips, strip_chains(strips), field, head_motion, forces)
        times, values = _clip(scene, hair, report)
    return _baked(document, strips, times, values)


@dataclass(frozen=True, eq=False)
class _Scene:
    """What does not change from frame to frame."""

    strips: StripSet
    chains: StripChains
    field: SurfaceField | None
    head_motion: HeadMotion
    forces: DynamicsParams

    @cached_property
    def collider(self) -> tuple[DistanceField, ...]:
        """The surface for the kernel."""
        return () if self.field is None else (self.field.collider,)

    def goal(self, secs: float) -> Array:
        """(R, 3) where the animation has the particles."""
        return moved(self.chains.middles(posed_points(self.strips, secs)), pose=self.head_motion(secs))

    def advanced(
        self, state: Particles, weights: Chains, goals: tuple[Array, Array], *, start: float, end: float, still: bool
    ) -> Particles:
        """The particles a frame later; with a head that is `still` before the clip."""
        moments = (start, start) if still else (start, end)
        poses = [np.tile(self.head_motion(secs), (len(self.collider), 1)) for secs in moments]
        return advanced(
            state,
            chains=weights,
            goals=goals,
            start_secs=start,
            duration_secs=end - start,
            params=self.forces,
            colliders=Colliders(fields=self.collider, before=poses[0], after=poses[1]),
        )

    def net(self, particles: Array, secs: float) -> Array:
        """(N, 3) control points in the strips' own frames, outside the surface where they were before."""
        goal = posed_points(self.strips, secs)
        points = self.chains.widened(moved_back(particles, pose=self.head_motion(secs)), goal=goal)
        if self.field is not None:
            keep = np.minimum(self.field.distance(goal), self.forces.clearance)
            points = self.field.pushed(points, keep=keep)
        return self.strips.frames.points_in_root(points, strip=self.strips.strip)


def _clip(scene: _Scene, hair: HairParams, report: Report) -> tuple[Array, Array]:
    """Times (K,) and control points (K, N, 3) in the strips' own frames."""
    step = 1 / hair.frames_per_sec
    settling = round(hair.settle_secs * hair.frames_per_sec)
    count = max(2, round(hair.duration_secs * hair.frames_per_sec) + 1)
    goal = scene.goal(0.0)
    weights = particles_of(goal, offsets=scene.chains.offsets, params=hair)
    report.number("particles", len(goal))
    state = Particles(goal, np.zeros_like(goal))
    for index in range(settling):
        state = scene.advanced(state, weights, (goal, goal), start=0.0, end=step, still=True)
        report.progress(index / (settling + count))
    values = [scene.net(state.position, 0.0)]
    for index in range(1, count):
        before, goal = goal, scene.goal(index * step)
        state = scene.advanced(state, weights, (before, goal), start=(index - 1) * step, end=index * step, still=False)
        values.append(scene.net(state.position, index * step))
        report.progress((settling + index) / (settling + count))
    report.number("last_speed", float(np.linalg.norm(state.velocity, axis=1).max()))
    return np.arange(count) * step, np.array(values)


def _baked(document: Document, strips: StripSet, times: Array, values: Array) -> Diff:
    """The strips' keyframes; those that moved them before, themselves or by their groups, go."""
    old = {
        name: item
        for name, item in document.of_type(Keyframes).items()
        if _moves_only(document, item.target, set(strips.names))
    }
    fresh = FreshNames(document)
    added = {}
    for index, name in enumerate(strips.names):
        own = values[:, strips.offsets[index] : strips.offsets[index + 1]]
        net = own.reshape(len(times), *strips.shapes[index], 3)
        key = fresh.next(f"{name}_simulated")
        added[key] = Keyframes(target=name, times=times, values=net, interpolation="linear", kind="position")
    return Diff(added=added, removed=old)


def _moves_only(document: Document, target: str, simulated: set[str]) -> bool:
    """Whether a motion of `target` moves strips that are simulated; raises `InputError` where it moves others too."""
    moved_strips = set(strip_names(document, [target]))
    if moved_strips & simulated and not moved_strips <= simulated:
        raise InputError(
            f"The keyframes of {target!r} move strips that are simulated and others that are not; "
            f"simulate all of {target!r}, or take its keyframes away first."
        )
    return bool(moved_strips & simulated)
