"""From a document to what can be seen: the waist that renderers and formats read."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from tress.model.document import Document
from tress.model.frozen_map import FrozenMap
from tress.model.mesh import Mesh
from tress.model.strands import Strands


@dataclass(frozen=True)
class Scene:
    """Strands and meshes by the identifier of their record; in the head frame, metres."""

    strands: Mapping[str, Strands] = field(default_factory=dict)
    meshes: Mapping[str, Mesh] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "strands", FrozenMap(self.strands))
        object.__setattr__(self, "meshes", FrozenMap(self.meshes))

    __hash__ = None  # type: ignore[assignment]


def evaluate(document: Document, time: float = 0.0) -> Scene:
    """What there is to see of the document at `time` (seconds): each record says it for itself."""
    found = {name: record.evaluated(document, time, name=name) for name, record in document.records.items()}
    return Scene(
        strands={name: seen for name, seen in found.items() if isinstance(seen, Strands)},
        meshes={name: seen for name, seen in found.items() if isinstance(seen, Mesh)},
    )
