"""A moment of a moving document, standing still."""

from dataclasses import replace

from tress.model.document import Document
from tress.model.keyframes import Keyframes
from tress.model.strip import Strip
from tress.model.strip_set import posed_points, strip_set


def posed(document: Document, time: float) -> Document:
    """The document with every strip where it is at `time` (seconds), and without keyframes: for what shows one moment.

    Roots, groups and everything else stay. A document without keyframes comes back as it is.
    """
    moving = document.of_type(Keyframes)
    if not moving:
        return document
    names = tuple(document.of_type(Strip))
    strips = strip_set(document, names)
    points = strips.frames.points_in_root(posed_points(strips, time), strip=strips.strip)
    moved = {
        name: replace(record, points=net)
        for name, record, net in zip(names, strips.records, strips.nets(points), strict=True)
    }
    return Document({name: moved.get(name, item) for name, item in document.records.items() if name not in moving})
