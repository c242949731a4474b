"""One folder with levels of detail: the job that the command runs."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from PIL import Image

from tress.app.level_sheet import Comparison, level_sheet
from tress.app.saved_document import opened
from tress.base.report import Report
from tress.io.atomic import OutputFolder
from tress.io.card_levels import CardLevels, card_levels
from tress.io.formats.glb import GlbParams, encode_glb, scene_beside_strips
from tress.io.report_file import write_report
from tress.io.strip_glb import CardParams, encode_levels
from tress.methods.strips.level_likeness import Likeness, level_points, likeness, spacing_for, views_of
from tress.methods.strips.level_switch import HYSTERESIS
from tress.methods.strips.levels import LevelChain, LevelParams, level_chain
from tress.model.document import Document

NAME = "hair"


@dataclass(frozen=True)
class LodOptions:
    """What the user asked for; the fields are those of `tress lod --help`."""

    source: Path
    folder: Path
    budgets: tuple[int, ...]
    levels: LevelParams = field(default_factory=LevelParams)
    cards: CardParams = field(default_factory=CardParams)
    measure: bool = True


@dataclass(frozen=True)
class Delivery:
    """What was written: a folder and the files in it, relative to it."""

    folder: Path
    files: tuple[Path, ...]


def run_lod(options: LodOptions, *, report: Report) -> Delivery:
    """Makes and delivers. Raises the errors of both; then nothing was written."""
    with report.stage("read"):
        document = opened(options.source, report=report)
    with report.stage("levels"):
        chain = level_chain(document, budgets=options.budgets, params=options.levels, report=report)
    for number, level in enumerate(chain.levels):
        with report.stage(f"level {number}"):
            report.number("triangles", level.triangles)
            report.number("strips", len(level.names))
    pairs, found = _measured(document, chain, options, report) if options.measure else ((), ())
    with report.stage("motion"):
        cards = card_levels(document, chain.levels, atlases=chain.atlases, coverage=chain.height_share)
        report.number("morph_targets", 0 if cards.motion is None else len(cards.motion.shapes))
    with OutputFolder(options.folder) as output:
        with report.stage("files"):
            _write(document, chain, cards, found, options, output.path)
        with report.stage("preview"):
            sheet = level_sheet(document, chain, compared=pairs, threshold=options.cards.threshold)
            Image.fromarray(sheet).save(output.path / "preview.png", compress_level=4)
        write_report(report, output.path / "report.json", facts={"levels": asdict(options.levels)})
        files = tuple(sorted(file.relative_to(output.path) for file in output.path.rglob("*") if file.is_file()))
    return Delivery(options.folder, files)


def _measured(
    document: Document, chain: LevelChain, options: LodOptions, report: Report
) -> tuple[tuple[Comparison, ...], tuple[Likeness, ...]]:
    """Every level but the first beside the first, where it takes over: what is seen, and how alike it is."""
    with report.stage("likeness"):
        pairs = tuple(_compared(document, chain, number, options) for number in range(1, len(chain.levels)))
        found = tuple(likeness(pair.level, pair.finest) for pair in pairs)
        for number, each in enumerate(found, start=1):
            report.number(f"silhouette_iou_{number}", each.silhouette_iou)
            report.number(f"color_difference_{number}", each.color_difference)
        return pairs, found


def _compared(document: Document, chain: LevelChain, number: int, options: LodOptions) -> Comparison:
    distance = chain.takeover_m[number - 1]
    px_per_m = options.levels.px_at_1_m / distance
    spacing, threshold = spacing_for(px_per_m), options.cards.threshold
    clouds = [
        level_points(document, chain.levels[k], atlases=chain.atlases[k], spacing_m=spacing, threshold=threshold)
        for k in (0, number)
    ]
    finest, level = views_of(clouds, px_per_m=px_per_m)
    return Comparison(number, distance, level, finest)


def _write(
    document: Document,
    chain: LevelChain,
    cards: CardLevels,
    found: Sequence[Likeness],
    options: LodOptions,
    folder: Path,
) -> None:
    scene, params = scene_beside_strips(document), GlbParams(cards=options.cards)
    (folder / f"{NAME}.glb").write_bytes(encode_glb(scene, params=params, strips=cards))
    for number, level in enumerate(cards.levels):
        data = encode_levels([level], name=NAME, motion=cards.motion, step=cards.step, params=options.cards)
        (folder / f"{NAME}_lod{number}.glb").write_bytes(data)
    (folder / "lod.json").write_text(json.dumps(_description(chain, cards, found), indent=2) + "\n")


def _description(chain: LevelChain, cards: CardLevels, found: Sequence[Likeness]) -> dict[str, Any]:
    """What a program needs to choose between the files."""
    takeover = (0.0, *chain.takeover_m)
    likenesses = [None, *(asdict(each) for each in found)] if found else [None] * len(takeover)
    levels = [
        {
            "file": f"{NAME}_lod{number}.glb",
            "takeover_m": takeover[number],
            "triangles": sum(len(card.triangles) for card in cards.levels[number].cards),
            "strips": len(level.names),
            "texture_px": {name: list(atlas.color.shape[1::-1]) for name, atlas in chain.atlases[number].items()},
            "likeness": likenesses[number],
        }
        for number, level in enumerate(chain.levels)
    ]
    return {"hysteresis": HYSTERESIS, "levels": levels}
