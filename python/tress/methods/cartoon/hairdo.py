"""A preset on the built-in head, or on a fitted one, kept off the skin at every moment."""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.base.report import Report
from tress.edit.add import add
from tress.edit.clearances import clearances
from tress.edit.push_out import push_out
from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.clump import DEGREE
from tress.methods.cartoon.presets.registry import PRESETS
from tress.methods.preset import chosen
from tress.methods.strips.bald_document import HEAD, bald_document
from tress.methods.strips.edited import edited
from tress.methods.strips.layers import HAIR
from tress.model.document import Document
from tress.model.keyframes import Keyframes
from tress.model.posed import posed
from tress.model.recipe import Recipe, flat_parameters
from tress.model.record import Record
from tress.model.strip import Strip
from tress.model.strips import strip_names

Array = np.ndarray[Any, Any]

CLEARANCE_M = 0.001


def hairdo(
    preset: str,
    *,
    params: CartoonParams | None = None,
    head: Document | None = None,
    report: Report | None = None,
) -> Document:
    """A document with `head`, hidden originating surfaces in the group `surfaces`, and clumps in groups within `hair`.

    No clump lies inside the head, nor at any keyframe. `head` is a document with a record `head` to take instead of the
    built-in one. The report gets how many clumps lay inside and were moved. The same settings give the same bits.
    Raises `InputError` for an unknown preset.

    >>> from tress.model.strip import Strip
    >>> len(hairdo("bob_bangs").of_type(Strip)) > 30
    True
    """
    grow, settings, report = chosen(PRESETS, preset).grow, params or CartoonParams(), report or Report()
    with report.stage("grow"):
        document = grow(head or bald_document(), settings)
        report.number("clumps", len(strip_names(document, [HAIR])))
    with report.stage("push out"):
        document = pushed_at_every_moment(document, report=report)
        least = np.array(list(clearances(document, names=[HAIR], surface=HEAD).values()))
        report.number("left_inside", int((least < 0).sum()))
        report.number("least_clearance_mm", float(1000 * least.min()))
    recipe = Recipe(method=f"cartoon {preset}", seed=settings.seed, parameters=flat_parameters(settings))
    return edited(document, add, records={"recipe": recipe})


def pushed_at_every_moment(document: Document, *, report: Report | None = None) -> Document:
    """The document with all clumps outside the head, at rest and at each of the clumps' own keyframes."""
    moving = {
        name: item
        for name, item in document.of_type(Keyframes).items()
        if item.kind == "position" and item.target in set(strip_names(document, [HAIR]))
    }
    times = np.unique(np.concatenate([np.zeros(0), *(item.times for item in moving.values())]))
    nets = {name: item.values.copy() for name, item in moving.items()}
    for time in times:
        still = posed(document, float(time))
        at = {name: np.flatnonzero(item.times == time) for name, item in moving.items()}
        inside = [name for name, room in clearances(still, names=[HAIR], surface=HEAD).items() if room < 0]
        outside = edited(still, push_out, names=inside, surface=HEAD, clearance_m=CLEARANCE_M) if inside else still
        for name, item in moving.items():
            strip = outside.records[item.target]
            if isinstance(strip, Strip) and item.target in inside and len(at[name]):
                nets[name][at[name]] = _closed_as(item.values[at[name]][0], strip.points)
    records: dict[str, Record] = {name: replace(item, values=nets[name]) for name, item in moving.items()}
    before = Document({**document.records, **records})
    after = edited(before, push_out, names=[HAIR], surface=HEAD, clearance_m=CLEARANCE_M, report=report)
    strips = before.of_type(Strip)
    closed = {
        name: replace(strip, points=_closed_as(strips[name].points, strip.points))
        for name, strip in after.of_type(Strip).items()
        if strip is not strips[name]
    }
    return Document({**after.records, **closed})


def _closed_as(before: Array, after: Array) -> Array:
    """A pushed net (U, V, 3) whose first and last columns, where they were the same, meet in the middle again."""
    same = [count for count in (DEGREE, 1) if np.array_equal(before[:, :count], before[:, -count:])]
    if not same:
        return after
    net, count = after.copy(), same[0]
    net[:, :count] = net[:, -count:] = 0.5 * (after[:, :count] + after[:, -count:])
    return net
