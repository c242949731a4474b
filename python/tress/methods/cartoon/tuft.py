"""From a surface of a document to clumps in a group, which follow it."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.edit.surface_distance import skin
from tress.kernel.nurbs import Patch
from tress.methods.cartoon.clearance import kept_off
from tress.methods.cartoon.clump import ClumpShape, Swept, clump_scale, swept
from tress.methods.cartoon.key_hairs import key_hairs
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.splitting import SplitParams, split
from tress.methods.cartoon.variation import ClumpVariation, varied
from tress.model.attachment import surface_mesh
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.group import Group, lineage
from tress.model.keyframes import Keyframes
from tress.model.mesh import Mesh
from tress.model.record import Record
from tress.model.strip import Strip
from tress.model.strip_set import posed_points, strip_set

Array = np.ndarray[Any, Any]

SMOOTHEST = {"step": 0, "linear": 1, "cubic": 2}


@dataclass(frozen=True, eq=False)
class Tuft:
    """All that says how one surface becomes clumps."""

    hairs: KeyHairParams = field(default_factory=KeyHairParams)
    clump: ClumpParams = field(default_factory=ClumpParams)
    shape: ClumpShape = field(default_factory=ClumpShape)
    variation: ClumpVariation = field(default_factory=ClumpVariation)
    split: SplitParams = field(default_factory=SplitParams)


def tuft_clumps(surface: Patch, *, tuft: Tuft = Tuft(), head: Mesh | None = None, clearance_m: float = 0.001) -> Swept:
    """The clumps of a surface as it is at one moment, the same chances at every moment.

    With the `skin` of a `head`, key hairs are kept so far outside that clumps lie on it.
    """
    drawn = varied(tuft.variation, count=tuft.hairs.hairs)
    hairs = key_hairs(surface, params=tuft.hairs, lengths=drawn.length)
    hairs = replace(hairs, points=hairs.points + drawn.lift[:, None, None] * hairs.normals)
    radius = drawn.radius * tuft.clump.horizontal_radius
    hairs = split(hairs, params=tuft.split, radius=radius)
    ways = tuft.split.ways
    radius = np.repeat(drawn.radius, ways) * (tuft.split.slimmer if ways > 1 else 1.0)
    twist = np.repeat(drawn.twist, ways)
    if head is not None:
        scale = clump_scale(np.linspace(0, 1, tuft.hairs.points), params=tuft.clump, shape=tuft.shape)
        thick = _thickness(tuft, twist[:, None] * np.linspace(0, 1, tuft.hairs.points))
        hairs = kept_off(hairs, mesh=head, room=clearance_m + radius[:, None] * scale * thick)
    return swept(hairs, params=tuft.clump, shape=tuft.shape, radius=radius, twist=twist)


def _thickness(tuft: Tuft, angle: Array) -> Array:
    """How far a clump of full radii reaches along the surface's normal once it has turned by `angle`."""
    across, up = np.abs(tuft.shape.root.points).max(axis=0)
    flat, thick = across * tuft.clump.horizontal_radius, up * tuft.clump.vertical_radius
    return np.hypot(thick * np.cos(angle), flat * np.sin(angle))


def clump_surface(
    document: Document,
    *,
    surface: str,
    into: str,
    tuft: Tuft = Tuft(),
    head: str = "",
    clearance_m: float = 0.001,
) -> Diff:
    """Adds the clumps of the strip `surface` as strips in the group `into`, which is there or comes into the root.

    Where keyframes move the surface, clumps are made anew at each of their moments and get keyframes themselves, of
    positions, so that they follow. With `head`, a head or mesh, they are kept off it at every moment: key hairs by the
    clumps' thickness and `clearance_m`, so that wide clumps on hollow places may still touch. The surface stays as it
    is; hide it where it should not be seen. Cost: some 10 ms for 10 clumps and moment, most of it for the head.
    Raises `InputError` where `surface` is no strip, and what the settings of the tuft are refused with.
    Source: Modelling and Animating Cartoon Hair, section 3.
    """
    if not isinstance(document.records.get(surface), Strip):
        raise InputError(f"Clumps are made of surfaces, but {surface!r} is no strip of the document.")
    mesh = skin(surface_mesh(document, head, where="A clump")) if head else None

    def at(patch: Patch) -> Swept:
        return tuft_clumps(patch, tuft=tuft, head=mesh, clearance_m=clearance_m)

    moving = _moving(document, surface)
    resting = at(surface_patch(document, surface, time=None))
    names = [f"{into}_{index:03d}" for index in range(len(resting.points))]
    records: dict[str, Record] = {} if into in document.records else {into: Group()}
    records |= {name: _strip(resting, index, into) for index, name in enumerate(names)}
    if moving:
        times = np.unique(np.concatenate([item.times for item in moving]))
        nets = np.stack([at(surface_patch(document, surface, time=float(time))).points for time in times], axis=1)
        records |= {f"{name}_motion": _motion(name, times, net, moving) for name, net in zip(names, nets, strict=True)}
    taken = sorted(set(records) & set(document.records))
    if taken:
        raise InputError(f"Record {taken[0]!r} is there already; choose another group than {into!r}.")
    return Diff(added=records)


def surface_patch(document: Document, name: str, *, time: float | None) -> Patch:
    """The strip `name` as a surface at `time` (seconds), or at rest for None; in the head frame."""
    strips = strip_set(document, [name])
    strip = strips.records[0]
    still = replace(strips, motion=None) if time is None else strips
    net = still.nets(posed_points(still, time or 0.0))[0]
    return Patch(net, strip.weights, strip.knots_u, strip.knots_v, *strip.degrees)


def _moving(document: Document, name: str) -> list[Keyframes]:
    strip = document.records[name]
    targets = {name, *(lineage(document, strip.group) if isinstance(strip, Strip) else ())}
    return [item for item in document.of_type(Keyframes).values() if item.target in targets]


def _strip(clumps: Swept, index: int, group: str) -> Strip:
    return Strip(
        points=clumps.points[index],
        weights=clumps.weights,
        knots_u=clumps.knots_u,
        knots_v=clumps.knots_v,
        group=group,
    )


def _motion(name: str, times: Array, net: Array, moving: list[Keyframes]) -> Keyframes:
    """Positions (K, U, V, 3) at times (K,), between them as the smoothest of what moves the surface goes."""
    smoothest = max((item.interpolation for item in moving), key=lambda word: SMOOTHEST[word])
    again = all(item.loop and item.times[0] == times[0] and item.times[-1] == times[-1] for item in moving)
    loop = again and len(times) > 1
    return Keyframes(target=name, times=times, values=net, kind="position", interpolation=smoothest, loop=loop)
