"""Chains of levels of detail for given budgets of triangles.

A level keeps the surfaces and shows them with fewer polygons. Where a budget leaves a strip less than a handful,
strips that lie alike are merged: the one that shows less goes, the other becomes wider, so that the hair covers as much
as before. What is left of the budget is shared out so that the sum of squared errors in sight is least.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.base.params import Params, param
from tress.base.report import Report
from tress.kernel.tessellation import segments_for
from tress.methods.strips.bent_rows import bent_rows
from tress.methods.strips.level_textures import level_atlases
from tress.methods.strips.merging import ALONG, merged
from tress.methods.strips.visible_area import visible_area
from tress.methods.strips.widening import widened
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.model.group import Group, lineage
from tress.model.level import Level
from tress.model.strip import Strip
from tress.model.strip_grid import even_strip_grid
from tress.model.strip_set import StripSet, kernel_patches, resting_points, strip_set
from tress.model.strips import visible_strips

Array = np.ndarray[Any, Any]

HIDDEN_SHARE = 0.05
"""Of its whole area, what a strip counts for beside what is seen of it: textures let hair below show through."""
STEPS = 12
MOST_POLYGONS = 4096
PX_OFF = 0.5
"""How far, in pixels, polygons may lie off a strip in the mean where a level takes over; fewer are as good."""
LINE = 48


@dataclass(frozen=True)
class LevelParams(Params):
    """How levels are made."""

    least_polygons: int = param(
        6,
        low=1,
        high=1000,
        doc="Strips are merged before they have fewer in the mean; where fewer do from afar, later.",
    )
    keep_all: bool = False
    widest: float = param(3.0, low=1.0, high=10.0, doc="No strip becomes wider than this times its width.")
    pixels: float = param(
        6.0, low=0.1, high=1000.0, unit="px", doc="A level takes over where its triangles fill this many pixels each."
    )
    picture_height: int = param(1080, low=16, high=16384, unit="px", doc="Height of the picture that is assumed.")
    field_of_view: float = param(45.0, low=1.0, high=170.0, unit="degrees", doc="Its vertical field of view.")
    threshold: float = param(0.5, low=0.01, high=0.99, doc="Alpha test at which levels cover the same area.")
    padding: int = param(16, low=1, high=256, unit="px", doc="Empty border around the regions of an atlas.")

    @property
    def px_at_1_m(self) -> float:
        """Pixels a metre at a distance of one metre."""
        return float(self.picture_height / (2 * np.tan(np.radians(self.field_of_view) / 2)))


@dataclass(frozen=True, eq=False)
class LevelChain:
    """Levels from the finest to the coarsest, and the distances (metres) at which each but the first takes over.

    `height_share` is the share of the picture's height that the hair takes at these distances, `atlases` are those of
    every level in the resolution that suits it.
    """

    levels: tuple[Level, ...]
    atlases: tuple[Mapping[str, Atlas], ...]
    takeover_m: tuple[float, ...]
    height_share: tuple[float, ...]


def level_chain(
    document: Document, *, budgets: Sequence[int], params: LevelParams | None = None, report: Report | None = None
) -> LevelChain:
    """A level for each budget of triangles, none exceeded.

    Raises `InputError` where there are no visible strips, where budgets do not fall, and where one cannot show the
    strips that must stay: one of every group and atlas, or all with `keep_all`.
    """
    params = params or LevelParams()
    names = shown_strips(document)
    if not names:
        raise InputError("The document shows no strips; levels of detail are made of strips.")
    _check_budgets(budgets)
    strips = strip_set(document, names)
    seen = visible_area(document, strips)
    detail = _Detail.of(document, strips, seen)
    tolerances = [0.0, *(PX_OFF * each / params.px_at_1_m for each in _distances(budgets, seen, params))]
    given = zip(budgets, tolerances, strict=True)
    plans = [_plan(detail, budget, number, params, tolerance) for number, (budget, tolerance) in enumerate(given)]
    triangles = [plan.level.triangles for plan in plans]
    distances = _distances(triangles, seen, params)
    atlases = level_atlases(
        document,
        takeover_m=distances,
        padding=params.padding,
        threshold=params.threshold,
        report=report or Report(),
    )
    levels = [plans[0].level]
    for plan, own, distance in zip(plans[1:], atlases[1:], distances, strict=True):
        levels.append(_covering(document, plan, own, (plans[0].level, atlases[0]), params, distance))
    height = float(np.ptp(resting_points(strips)[:, 1]))
    shares = tuple(min(1.0, height * params.px_at_1_m / params.picture_height / each) for each in distances)
    return LevelChain(tuple(levels), tuple(atlases), distances, shares)


def shown_strips(document: Document) -> tuple[str, ...]:
    """The strips that are not hidden, in alphabetical order."""
    groups = ["", *document.of_type(Group)]
    return tuple(sorted(name for group in groups for name in visible_strips(document, group=group)))


def takeover_distances(triangles: Sequence[int], *, area_m2: float, params: LevelParams) -> tuple[float, ...]:
    """Where every level but the first has triangles of `pixels` pixels: hair that shows `area_m2` fills
    area (pixels a metre / distance)² of them. Each is at least as far as the one before."""
    exact = [params.px_at_1_m * np.sqrt(area_m2 / (count * params.pixels)) for count in triangles[1:]]
    return tuple(np.maximum.accumulate(exact).tolist()) if exact else ()


def _distances(triangles: Sequence[int], seen: Array, params: LevelParams) -> tuple[float, ...]:
    return takeover_distances(triangles, area_m2=float(seen.sum()), params=params)


@dataclass(frozen=True, eq=False)
class _Detail:
    """What sharing out needs to know of S strips: `bend` (S,) square metres, the mean squared error of one polygon;
    `lines` (S, 49, 3) metres, points along their middles at even parameters."""

    strips: StripSet
    importance: Array
    bend: Array
    middles: Array
    lines: Array
    kind: Array

    @staticmethod
    def of(document: Document, strips: StripSet, seen: Array) -> "_Detail":
        count = len(strips.records)
        fine = even_strip_grid(strips.records, segments=np.full((count, 2), (2 * (ALONG - 1), 4)))
        points = fine.points(resting_points(strips)).reshape(count, 2 * ALONG - 1, 5, 3)
        cells = np.cross(points[:, 1:, :-1] - points[:, :-1, :-1], points[:, :-1, 1:] - points[:, :-1, :-1])
        area = np.linalg.norm(cells, axis=-1).sum(axis=(1, 2))
        labels = [(lineage(document, strip.group)[:1], strip.atlas) for strip in strips.records]
        order = {label: place for place, label in enumerate(sorted({str(label) for label in labels}))}
        return _Detail(
            strips=strips,
            importance=seen + HIDDEN_SHARE * area,
            bend=_bend(points),
            middles=points[:, ::2].mean(axis=2),
            lines=_lines(strips),
            kind=np.array([order[str(label)] for label in labels]),
        )


def _lines(strips: StripSet) -> Array:
    count = len(strips.records)
    grid = even_strip_grid(strips.records, segments=np.full((count, 2), (LINE, 2)))
    return grid.points(resting_points(strips)).reshape(count, LINE + 1, 3, 3).mean(axis=2)


def _bend(points: Array) -> Array:
    """(S,) mean squared distance of a grid of points (S, R, C, 3) from the plane quadrangle between its corners."""
    u = np.linspace(0, 1, points.shape[1])[:, None, None]
    v = np.linspace(0, 1, points.shape[2])[:, None]
    corner = points[:, [0, 0, -1, -1], [0, -1, 0, -1]]
    flat = ((1 - u) * ((1 - v) * corner[:, 0, None, None] + v * corner[:, 1, None, None])) + u * (
        (1 - v) * corner[:, 2, None, None] + v * corner[:, 3, None, None]
    )
    return np.square(points - flat).sum(axis=-1).mean(axis=(1, 2))


def _check_budgets(budgets: Sequence[int]) -> None:
    if not budgets:
        raise InputError("No budget of triangles was given; one for each level was expected, such as 20000,8000,2000.")
    if min(budgets) < 1 or any(later >= sooner for sooner, later in pairwise(budgets)):
        words = ", ".join(str(budget) for budget in budgets)
        raise InputError(f"The budgets are {words} triangles; positive numbers that fall were expected.")


@dataclass(frozen=True, eq=False)
class _Plan:
    """A level with strips as wide as they are, and for how many strips each stands: `share` (S,), from 1 up."""

    level: Level
    share: Array


def _plan(detail: _Detail, budget: int, number: int, params: LevelParams, tolerance_m: float) -> _Plan:
    count, polygons = len(detail.kind), budget // 2
    needed = count if params.keep_all else len(np.unique(detail.kind))
    if polygons < needed:
        why = "all stay, as asked" if params.keep_all else "one of every group and atlas stays"
        raise InputError(
            f"Level {number} has a budget of {budget} triangles for {needed} strips that must stay; "
            f"at least {2 * needed} were expected, a polygon of two triangles for each ({why})."
        )
    least = _least_polygons(detail, params, tolerance_m)
    wanted = count if params.keep_all else min(count, max(int(polygons / least), needed))
    found = merged(detail.middles, importance=detail.importance, kind=detail.kind, count=wanted)
    inherited = np.bincount(found.heir, weights=detail.importance, minlength=count)[found.kept]
    records = [detail.strips.records[index] for index in found.kept]
    segments = _shared_out(records, importance=inherited, bend=detail.bend[found.kept], polygons=polygons)
    share = np.minimum(inherited / np.maximum(detail.importance[found.kept], 1e-12), params.widest)
    names = tuple(detail.strips.names[index] for index in found.kept)
    rows = tuple(
        bent_rows(detail.lines[index], int(along)) for index, along in zip(found.kept, segments[:, 0], strict=True)
    )
    return _Plan(Level(names, segments, np.ones(len(names)), rows), share)


def _least_polygons(detail: _Detail, params: LevelParams, tolerance_m: float) -> float:
    """How many polygons a strip needs in the mean, so that more strips are kept where these are short and flat."""
    if tolerance_m <= 0:
        return params.least_polygons
    needed = np.ceil(np.sqrt(np.sqrt(detail.bend) / tolerance_m)).clip(1, params.least_polygons)
    return float(np.average(needed, weights=detail.importance))


def _covering(
    document: Document,
    plan: _Plan,
    atlases: Mapping[str, Atlas],
    finest: tuple[Level, Mapping[str, Atlas]],
    params: LevelParams,
    distance_m: float,
) -> Level:
    """The plan with wider strips, where it has fewer than the finest level."""
    if len(plan.level.names) == len(finest[0].names):
        return plan.level
    return widened(
        document,
        plan.level,
        share=plan.share,
        atlases=atlases,
        finest=finest,
        px_per_m=params.px_at_1_m / distance_m,
        threshold=params.threshold,
    )


def _shared_out(records: Sequence[Strip], *, importance: Array, bend: Array, polygons: int) -> Array:
    """(K, 2) int64 segments with at most `polygons` polygons in all.

    With n polygons a strip has an error of bend / n⁴ (its square; mostly along the hair, where n pieces err by 1 / n²);
    the weighted sum is least where n goes with the fifth root of weight times bend.
    """
    patches = kernel_patches(records)
    share = np.maximum(importance * bend, 1e-18) ** 0.2
    share /= share.sum()
    low, high, best = 0.0, 4.0 * polygons, np.ones((len(records), 2), np.int64)
    for _ in range(STEPS):
        middle = low + (high - low) / (8 if low == 0 else 2)
        wanted = np.clip(np.floor(share * middle), 1, MOST_POLYGONS).astype(np.int64)
        found = segments_for(patches, polygons=wanted)
        if found.prod(axis=1).sum() <= polygons:
            low, best = middle, found
        else:
            high = middle
    return best
