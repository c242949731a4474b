"""One folder with an atlas of strands: the job that the command runs."""

import dataclasses
import json
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from tress.base.report import Report
from tress.io.atlas_files import write_atlas_pictures
from tress.io.atomic import OutputFolder
from tress.io.formats.registry import format_of
from tress.io.report_file import write_report
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.render.textures.contact_sheet import atlas_sheet
from tress.render.textures.layout import card_layout
from tress.render.textures.map_codec import COLOR, codec_of
from tress.render.textures.mip_chain import MipLevel, mip_chain
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_atlas import strand_atlas

MIPS_FOLDER = "mips"
DOCUMENT = "atlas.usdc"
_LEAST_COVERAGE = 0.01
_THIN = 0.5
"""Below this share of the mean alpha, what passes the test looks thin."""


@dataclass(frozen=True)
class TextureOptions:
    """What the user asked for; the fields are those of `tress texture --help`."""

    folder: Path
    params: TextureParams
    mips: bool = True


@dataclass(frozen=True)
class Delivery:
    """What was written: a folder and the files in it, relative to it."""

    folder: Path
    files: tuple[Path, ...]


def run_texture(options: TextureOptions, *, report: Report) -> Delivery:
    """Draws and delivers. Raises the errors of both; then nothing was written."""
    params = options.params
    with report.stage("strands"):
        atlas = strand_atlas(params, report=report)
        _say_size(atlas, report)
    with report.stage("mip chain"):
        chain = mip_chain(atlas, padding=params.padding, threshold=params.threshold)
        report.number("levels", len(chain))
        report.number("largest_coverage_error", largest_coverage_error(chain))
        _warn_of_thin_hair(chain, params, report)
    with OutputFolder(options.folder) as output:
        with report.stage("files"):
            _write(options, chain, output.path)
        write_report(report, output.path / "report.json", facts={"parameters": dataclasses.asdict(params)})
        files = tuple(sorted(file.relative_to(output.path) for file in output.path.rglob("*") if file.is_file()))
    return Delivery(options.folder, files)


def largest_coverage_error(chain: Sequence[MipLevel]) -> float:
    """The largest relative change of a card's coverage on any level, of cards that cover a hundredth of their cell."""
    wanted = chain[0].coverage
    kept = wanted >= _LEAST_COVERAGE
    return max(float(np.abs(level.coverage[kept] / wanted[kept] - 1).max(initial=0)) for level in chain)


def _say_size(atlas: Atlas, report: Report) -> None:
    height, width = atlas.color.shape[:2]
    report.number("width", width)
    report.number("height", height)
    report.number("variations", len(atlas.regions))


def _warn_of_thin_hair(chain: Sequence[MipLevel], params: TextureParams, report: Report) -> None:
    """Strands much finer than a texel fail the alpha test from the start, and no mip chain brings them back."""
    layout = card_layout(params.variations, width=params.resolution, aspect=params.aspect, padding=params.padding)
    alpha = chain[0].atlas.color[..., 3]
    mean = np.array([alpha[layout.cell(card)].mean() / 255 for card in range(layout.count)])
    thin = np.flatnonzero(chain[0].coverage < _THIN * mean)
    if len(thin):
        report.warn(
            f"in {len(thin)} of {layout.count} variations most hair lies below the alpha threshold, its strands are "
            "finer than a texel; raise the resolution or the thickness, or blend instead of testing."
        )


def _write(options: TextureOptions, chain: Sequence[MipLevel], folder: Path) -> None:
    atlas = chain[0].atlas
    write_atlas_pictures(atlas, folder)
    if options.mips:
        (folder / MIPS_FOLDER).mkdir()
        with ThreadPoolExecutor() as pool:
            numbered = enumerate(chain[1:], start=1)
            list(pool.map(lambda one: _write_level(one[1], folder / MIPS_FOLDER, number=one[0]), numbered))
    document = folder / DOCUMENT
    format_of(document).write(Document(records={"atlas": atlas}), document)
    Image.fromarray(atlas_sheet(atlas)).save(folder / "preview.png", compress_level=4)
    (folder / "atlas.json").write_text(json.dumps(_description(options.params, chain), indent=2) + "\n")


def _write_level(level: MipLevel, folder: Path, *, number: int) -> None:
    write_atlas_pictures(level.atlas, folder, suffix=f"_{number}")


def _description(params: TextureParams, chain: Sequence[MipLevel]) -> dict[str, Any]:
    """Where everything lies, for programs that read the pictures."""
    atlas = chain[0].atlas
    height, width = atlas.color.shape[:2]
    words = {"color": COLOR.words, "alpha": "linear, 0 to 255 for 0 to 1"}
    return {
        "width": width,
        "height": height,
        "maps": {**words, **{name: codec_of(name).words for name in atlas.maps}},
        "padding": params.padding,
        "alpha_threshold": params.threshold,
        "variations": [_variation(params, chain, index, width, height) for index in range(len(atlas.regions))],
        "levels": [_level(level) for level in chain],
    }


def _variation(params: TextureParams, chain: Sequence[MipLevel], index: int, width: int, height: int) -> dict[str, Any]:
    region = chain[0].atlas.regions[index].astype(float)
    u_low, v_low, u_high, v_high = region
    left, top = round(u_low * width), round((1 - v_high) * height)
    return {
        "kind": params.kind_of(index),
        "uv": region.tolist(),
        "px": [left, top, round(u_high * width) - left, round((1 - v_low) * height) - top],
        "coverage": float(chain[0].coverage[index]),
    }


def _level(level: MipLevel) -> dict[str, Any]:
    height, width = level.atlas.color.shape[:2]
    return {
        "width": width,
        "height": height,
        "coverage": level.coverage.tolist(),
        "alpha_scale": level.scale.tolist(),
    }
