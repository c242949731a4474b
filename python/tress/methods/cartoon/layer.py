"""One layer of a cartoon hairdo: a hidden surface, and clumps along it in a group."""

from collections.abc import Mapping

from tress.edit.add import add
from tress.kernel.nurbs import Patch
from tress.methods.cartoon.scalp_cap import scalp_cap
from tress.methods.cartoon.skull import Skull
from tress.methods.cartoon.tuft import Tuft, clump_surface
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.edited import edited
from tress.methods.strips.layers import HAIR
from tress.model.document import Document
from tress.model.group import Group
from tress.model.keyframes import Keyframes
from tress.model.record import Record
from tress.model.strip import Strip

SURFACES, CAP = "surfaces", "cap"


def with_clumps(
    document: Document, *, name: str, surface: Patch, tuft: Tuft, motion: Mapping[str, Keyframes] | None = None
) -> Document:
    """The document with the surface as hidden strip `{name}_surface`, its `motion`, and clumps in the new group `name`
    within `hair`."""
    records: dict[str, Record] = {HAIR: Group(), SURFACES: Group(hidden=True), name: Group(parent=HAIR)}
    shown = {key: record for key, record in records.items() if key not in document.records}
    document = edited(document, add, records=shown)
    document = edited(document, add, records={f"{name}_surface": strip_of_patch(surface, group=SURFACES)})
    document = edited(document, add, records=dict(motion or {}))
    return edited(document, clump_surface, surface=f"{name}_surface", into=name, tuft=tuft, head=HEAD)


def with_cap(document: Document, skull: Skull) -> Document:
    """The document with a cap over the scalp in a group of its own."""
    records: dict[str, Record] = {HAIR: Group(), CAP: Group(parent=HAIR)}
    shown = {key: record for key, record in records.items() if key not in document.records}
    document = edited(document, add, records=shown)
    return edited(document, add, records={"cap_0": scalp_cap(skull, group=CAP)})


def strip_of_patch(patch: Patch, *, group: str = "") -> Strip:
    """A surface as a record."""
    return Strip(points=patch.points, weights=patch.weights, knots_u=patch.knots_u, knots_v=patch.knots_v, group=group)
