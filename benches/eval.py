"""Quality on the open data: `python -m benches.eval [synthetic|portraits|masks] …` prints a table for each.

Every photograph goes through the whole of `reconstruct` as a user's would. Absent data is said and passed over.
"""

import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from benches.eval_layers import hair_mask_iou_table
from benches.metrics import beside, psnr_db, ssim
from benches.open_data import portraits, scorer, synthetic_cases
from tress.app.portrait_job import PortraitOptions, run_portrait
from tress.base.errors import TressError
from tress.base.report import Report
from tress.io.photo import read_photo

CONSOLE = Console(width=140)
STRAND_KEY = "3mm_30deg"


def reconstruction_of(photo: Path, folder: Path) -> dict[str, np.ndarray]:
    """The arrays of `reconstruction.npz` after a run with the default parameters."""
    run_portrait(PortraitOptions(photo=photo, folder=folder, formats=("hair",), turntable=False), report=Report())
    with np.load(folder / "reconstruction.npz") as arrays:
        return dict(arrays)


def synthetic_table() -> Table:
    """The scorer's figures for the rendered cases with known truth."""
    table = Table(title="Rendered cases with known truth")
    columns = "F visible, F all, orientation, silhouette IoU, mask IoU, depth MAE, depth order, PSNR, SSIM"
    for column in ("case", *columns.split(", ")):
        table.add_column(column, justify="left" if column == "case" else "right")
    module = scorer()
    for case in synthetic_cases():
        with tempfile.TemporaryDirectory() as folder:
            score = module.score(str(case), reconstruction_of(case / "photo.png", Path(folder) / "out"))
        table.add_row(
            case.name,
            f"{score['strands_visible'][STRAND_KEY]['f']:.3f}",
            f"{score['strands_all'][STRAND_KEY]['f']:.3f}",
            f"{score['orientation_strands']['median_deg']:.1f}°",
            f"{score['silhouette_iou']:.3f}",
            f"{score['hair_mask_iou']:.3f}",
            f"{score['depth_mae_mm']:.1f} mm",
            f"{score['depth_order']['accuracy']:.2f}",
            f"{score['rerender']['psnr_db']:.1f} dB",
            f"{score['rerender']['ssim']:.3f}",
        )
    return table


def portraits_table() -> Table:
    """Likeness of the re-rendered hair in the original view, inside the hair mask and beside it, for every portrait."""
    table = Table(title="Re-rendered in the original view")
    for column in ("portrait", "PSNR", "SSIM", "PSNR beside"):
        table.add_column(column, justify="left" if column == "portrait" else "right")
    figures = []
    for photo in portraits():
        try:
            with tempfile.TemporaryDirectory() as folder:
                result = reconstruction_of(photo, Path(folder) / "out")
        except TressError as error:
            table.add_row(photo.stem, str(error), "", "")
            continue
        rerender, mask = result["rerender"][..., :3], result["hair_mask"] > 127
        original = read_photo(photo, max_size=max(mask.shape)).pixels
        around = beside(mask)
        figures.append(
            (
                psnr_db(rerender, original, mask=mask),
                ssim(rerender, original, mask=mask),
                psnr_db(rerender, original, mask=around),
            )
        )
        table.add_row(photo.stem, *_words(figures[-1]))
    if figures:
        median, least = np.median(figures, axis=0), np.min(figures, axis=0)
        table.add_row("median", *_words(median), style="bold")
        table.add_row("least", *_words(least), style="bold")
    return table


def _words(figures: Sequence[float]) -> tuple[str, str, str]:
    return f"{figures[0]:.1f} dB", f"{figures[1]:.3f}", f"{figures[2]:.1f} dB"


TABLES = {"synthetic": synthetic_table, "portraits": portraits_table, "masks": hair_mask_iou_table}

if __name__ == "__main__":
    for name in sys.argv[1:] or TABLES:
        CONSOLE.print(TABLES[name]())
