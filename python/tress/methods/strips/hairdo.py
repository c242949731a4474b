"""A preset on the built-in head, kept off the skin and covered with strands."""

from collections.abc import Mapping

import numpy as np

from tress.base.report import Report
from tress.edit.add import add
from tress.edit.clearances import clearances
from tress.edit.cover import cover
from tress.edit.push_out import push_out
from tress.methods.strips.bald_document import HEAD, bald_document
from tress.methods.strips.edited import edited
from tress.methods.strips.layers import CAP, EDGE, HAIR, OVER
from tress.methods.strips.params import StripsParams
from tress.methods.strips.presets.registry import preset_of
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.model.group import Group
from tress.model.recipe import Recipe, flat_parameters
from tress.model.strip import Strip

ATLAS = "strands"
CLEARANCE_M = 0.002


def hairdo(
    preset: str,
    *,
    params: StripsParams | None = None,
    atlas: Atlas | None = None,
    head: Document | None = None,
    report: Report | None = None,
) -> Document:
    """A document with `head` and the strips of a preset, in groups within `hair`; no strip lies inside the head.

    With an `atlas`, strips are covered with its regions in turn. `head` is a document with a record `head` to take
    instead of the built-in one. The report gets how many strips lay inside and were moved. The same settings give the
    same bits. Raises `InputError` for an unknown preset.

    >>> from tress.model.strip import Strip
    >>> len(hairdo("bob", params=StripsParams(strips=60)).of_type(Strip)) > 40
    True
    """
    chosen, settings, report = preset_of(preset), params or StripsParams(), report or Report()
    with report.stage("grow"):
        document = chosen.grow(head or bald_document(), settings)
        report.number("strips", len(document.of_type(Strip)))
    with report.stage("push out"):
        document = edited(document, push_out, names=[HAIR], surface=HEAD, clearance_m=CLEARANCE_M, report=report)
        least = np.array(list(clearances(document, names=[HAIR], surface=HEAD).values()))
        report.number("left_inside", int((least < 0).sum()))
        report.number("least_clearance_mm", float(1000 * least.min()))
    records: Mapping[str, Recipe | Atlas] = {
        "recipe": Recipe(method=f"strips {preset}", seed=settings.seed, parameters=flat_parameters(settings))
    }
    document = edited(document, add, records=records)
    return document if atlas is None else covered(document, atlas)


def covered(document: Document, atlas: Atlas) -> Document:
    """The document with all strips covered with the regions of an atlas, in turn.

    Atlases begin with their densest cards: the cap has the densest quarter, layers above it the denser half, the
    outermost all, and the hairline those in the middle.
    """
    document = edited(document, add, records={ATLAS: atlas})
    for name, group in document.of_type(Group).items():
        if group.parent == HAIR:
            regions = _regions(name, len(atlas.regions))
            document = edited(document, cover, names=[name], atlas=ATLAS, regions=regions)
    return document


def _regions(group: str, count: int) -> range:
    if group == CAP:
        return range(max(count // 4, 1))
    if group == EDGE:
        return range(count // 4, max(3 * count // 4, 1))
    return range(count if group == OVER else max(count // 2, 1))
