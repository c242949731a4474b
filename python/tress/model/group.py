"""Strips that belong together."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from tress.base.errors import InputError
from tress.model.mesh import Mesh
from tress.model.record import Record

if TYPE_CHECKING:
    from tress.model.document import Document


@dataclass(frozen=True, eq=False)
class Group(Record):
    """Strips that are shown as one mesh, and hidden, locked and moved together; `parent` is a group or "".

    The strips name their group, not the group its strips. What is hidden or locked holds for all within. The strips
    directly in a group are covered with one atlas, as one mesh is.
    """

    parent: str = ""
    hidden: bool = False
    locked: bool = False

    def check_in(self, document: "Document", *, name: str) -> None:
        """The parent is a group, no group lies within itself, and there is one atlas."""
        from tress.model.strips import strips_in  # it reads strips, which know their group

        atlases = sorted({strip.atlas for strip in strips_in(document, name).values()})
        if len(atlases) > 1:
            listed = ", ".join(atlas or "none" for atlas in atlases)
            raise InputError(f"Strips of the group {name!r} are covered with several atlases ({listed}); use one.")
        seen, group = {name}, self.parent
        while group:
            record = document.records.get(group)
            if not isinstance(record, Group):
                raise InputError(f"Group {name!r} lies in {group!r}, which is no group of the document.")
            if group in seen:
                raise InputError(f"Group {name!r} lies within itself; groups are a tree.")
            seen.add(group)
            group = record.parent

    def evaluated(self, document: "Document", time: float, *, name: str) -> Mesh | None:
        """One mesh of the visible strips that are directly in the group; None where there are none."""
        from tress.model.strip_mesh import strips_mesh  # it reads strips, which know their group
        from tress.model.strips import visible_strips

        names = visible_strips(document, group=name)
        return strips_mesh(document, names=names, time=time) if names else None


def lineage(document: "Document", group: str) -> list[str]:
    """The group and those that it lies in, the innermost first; empty for ""."""
    result = []
    while group:
        result.append(group)
        record = document.records[group]
        group = record.parent if isinstance(record, Group) else ""
    return result
