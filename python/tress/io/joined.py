"""All strands of a scene as one, for formats that hold one set."""

import numpy as np

from tress.base.errors import InputError
from tress.model.document import Document
from tress.model.evaluate import Scene, evaluate
from tress.model.strands import Strands
from tress.model.strip import Strip


def strands_alone(document: Document, *, form: str) -> Strands:
    """All strands of a document as one, for the format `form`, which holds nothing else.

    Raises `InputError` where the document has no strands, so that no file is written that is empty.
    """
    scene = evaluate(document)
    if scene.strands:
        return joined_strands(scene)
    strips = len(document.of_type(Strip))
    found = f"{strips} strips and no strands" if strips else "no strands"
    raise InputError(f"{form} holds strands alone, and the document has {found}; .usdc, .glb and .obj hold the rest.")


def joined_strands(scene: Scene) -> Strands:
    """The strands of all records one after the other, in the order of their identifiers.

    An attribute is kept where every part has it with the same dtype and shape. Without strands, there are none in it.
    """
    parts = [strands for strands in scene.strands.values() if strands.count]
    if len(parts) == 1:
        return parts[0]
    if not parts:
        return Strands(points=np.zeros((0, 3), np.float32), offsets=np.zeros(1, np.int64))
    starts = np.cumsum([0, *(len(part.points) for part in parts)])
    offsets = [part.offsets[1:] + start for part, start in zip(parts, starts[:-1], strict=True)]
    return Strands(
        points=np.concatenate([part.points for part in parts]),
        offsets=np.concatenate([np.zeros(1, np.int64), *offsets]),
        point_attributes=_joined([part.point_attributes for part in parts]),
        strand_attributes=_joined([part.strand_attributes for part in parts]),
    )


def _joined(parts: list) -> dict[str, np.ndarray]:
    shared = [name for name in parts[0] if all(name in part for part in parts)]
    rows = {name: [part[name] for part in parts] for name in shared}
    return {
        name: np.concatenate(values)
        for name, values in rows.items()
        if len({(value.dtype, value.shape[1:]) for value in values}) == 1
    }
