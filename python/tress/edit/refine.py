"""More control points for the same surface."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from tress.edit.selection import editable_strips
from tress.kernel import nurbs
from tress.model.diff import Diff
from tress.model.document import Document
from tress.model.keyframes import Keyframes
from tress.model.record import Record
from tress.model.strip import Strip
from tress.model.tracks import stretched

Array = np.ndarray[Any, Any]


def refine(document: Document, *, names: Iterable[str], knots_u: Any = (), knots_v: Any = ()) -> Diff:
    """Inserts knots along and across, all at once: more control points to shape by, and the same surface.

    Keyframes of the strips themselves are refined too, so that the motion stays; those of a group go on stretching
    their net over the new one. Raises `InputError` for knots outside the domain or repeated more often than the degree,
    and where a strip is locked. Source: the Oslo algorithm, Cohen, Lyche, Riesenfeld 1980.
    """
    pairs: dict[str, tuple[Record, Record]] = {}
    motions = document.of_type(Keyframes)
    for name, before in editable_strips(document, names).items():
        pairs[name] = (before, _refined(before, before.points, knots_u, knots_v))
        for key, motion in motions.items():
            if motion.target == name and motion.values.shape[1:3] != (1, 1):
                pairs[key] = (motion, _refined_motion(motion, before, knots_u, knots_v))
    return Diff(updated=pairs)


def _refined(strip: Strip, points: Array, knots_u: Any, knots_v: Any) -> Strip:
    """A strip of `points` and the other properties of `strip`, refined."""
    degree_u, degree_v = strip.degrees
    old = nurbs.Patch(points, strip.weights, strip.knots_u, strip.knots_v, degree_u, degree_v)
    new = nurbs.refine(old, knots_u=knots_u, knots_v=knots_v)
    return replace(strip, points=new.points, weights=new.weights, knots_u=new.knots_u, knots_v=new.knots_v)


def _refined_motion(motion: Keyframes, strip: Strip, knots_u: Any, knots_v: Any) -> Keyframes:
    """Displacements are the control points of a moving surface with the weights of the strip."""

    def refined(values: Array) -> Array:
        nets = stretched(values, strip.weights.shape)
        return np.stack([_refined(strip, net, knots_u, knots_v).points for net in nets])

    tangents = None if motion.tangents is None else refined(motion.tangents)
    return replace(motion, values=refined(motion.values), tangents=tangents)
