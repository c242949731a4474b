"""`report.json`: what was made of what, how long it took, and what went wrong on the way."""

import importlib.metadata
import json
import platform
import resource
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from tress import __version__
from tress.base.report import Report

_VERSIONS_OF: Final = ("numpy", "scipy", "opencv-python-headless", "scikit-image", "pillow", "usd-core")


def write_report(report: Report, path: Path, *, facts: Mapping[str, Any]) -> None:
    """Writes versions, `facts`, and time, figures and warnings of every stage as JSON. Raises `OSError`."""
    stages = report.as_dict()
    content = {
        "versions": versions(),
        **facts,
        "duration_secs": sum(stage["duration_secs"] for stage in stages),
        "peak_memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "warnings": [f"{stage['name']}: {warning}" for stage in stages for warning in stage["warnings"]],
        "stages": stages,
    }
    path.write_text(json.dumps(content, indent=2) + "\n")


def versions() -> dict[str, str]:
    """Versions of Tress, of Python and of what the result depends on."""
    libraries = {name: importlib.metadata.version(name) for name in _VERSIONS_OF}
    return {"tress": __version__, "python": platform.python_version(), **libraries}
