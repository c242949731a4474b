"""The files of a reconstruction: formats, preview, turntable, report, plain arrays, and the stages."""

import importlib.metadata
import json
import platform
import resource
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
from PIL import Image

from tress import __version__
from tress.base.report import Report
from tress.io.format import Format
from tress.io.stage_cache import StageCache
from tress.methods.portrait.pipeline import STAGES, Reconstruction

STAGES_FOLDER: Final = "stages"
_VERSIONS_OF: Final = ("numpy", "scipy", "opencv-python-headless", "scikit-image", "pillow", "usd-core")


def deliver(
    reconstruction: Reconstruction,
    folder: Path,
    *,
    formats: Sequence[Format],
    facts: Mapping[str, Any],
    report: Report,
) -> None:
    """Writes every file of a reconstruction into `folder`, which exists. Raises `OSError` and `OutputError`.

    `formats` says which files the hair is written to, `facts` what the report says besides times and figures.
    """
    with report.stage("stages"):
        deliver_stages(reconstruction, folder)
    with report.stage("formats"):
        deliver_formats(reconstruction, folder, formats=formats)
    deliver_report(report, folder, facts=facts)


def deliver_stages(reconstruction: Reconstruction, folder: Path) -> None:
    """For every stage its result (`NN_name.npz`, for `--from-stage`) and its picture (`NN_name.png`)."""
    cache = StageCache(folder / STAGES_FOLDER)
    for number, stage in enumerate(STAGES, start=1):
        print_of_stage = reconstruction.fingerprints[stage.name]
        cache.save(reconstruction.work[stage.name], number=number, name=stage.name, fingerprint=print_of_stage)
        write_picture(stage.picture(reconstruction.work), cache.path(number, stage.name).with_suffix(".png"))


def deliver_formats(reconstruction: Reconstruction, folder: Path, *, formats: Sequence[Format]) -> None:
    """The document as `hair` in each format."""
    for form in formats:
        form.write(reconstruction.document, folder / f"hair{form.suffixes[0]}")


def deliver_report(report: Report, folder: Path, *, facts: Mapping[str, Any]) -> None:
    """`report.json`: versions, `facts`, and time, figures and warnings of every stage."""
    stages = report.as_dict()
    content = {
        "versions": versions(),
        **facts,
        "duration_secs": sum(stage["duration_secs"] for stage in stages),
        "peak_memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "warnings": [f"{stage['name']}: {warning}" for stage in stages for warning in stage["warnings"]],
        "stages": stages,
    }
    (folder / "report.json").write_text(json.dumps(content, indent=2) + "\n")


def versions() -> dict[str, str]:
    """Versions of Tress, of Python and of what the result depends on."""
    libraries = {name: importlib.metadata.version(name) for name in _VERSIONS_OF}
    return {"tress": __version__, "python": platform.python_version(), **libraries}


def write_picture(pixels: np.ndarray, path: Path) -> None:
    """`pixels` (H, W, 3 | 4) uint8 sRGB as PNG."""
    Image.fromarray(pixels).save(path, compress_level=4)
