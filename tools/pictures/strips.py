"""The pictures of strips: a preset made, moved and coarsened by the commands that a user would run."""

import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from tools.pictures.sheets import save

_COMMAND = (sys.executable, "-c", "from tress.app.cli import main; main()")


def keyframes_wind(folder: Path) -> None:
    """Moments of long hair in the wind."""
    made = folder / "wind"
    _run("keyframes", _hairdo(folder), "-o", made, "--motion", "wind", "--amplitude", 0.06, "--no-turntable")
    save(_picture(made / "preview.png"), "keyframes_wind")


def levels_of_detail(folder: Path) -> None:
    """Three levels of long hair, near by and as far as each takes over."""
    made = folder / "levels"
    _run("lod", _hairdo(folder), "-o", made, "--lod", "20000,8000,2000")
    save(_picture(made / "preview.png"), "levels_of_detail")


def _hairdo(folder: Path) -> Path:
    """The document of a preset, made once."""
    made = folder / "long_straight"
    if not made.exists():
        _run("strips", "--preset", "long_straight", "-o", made, "--no-turntable", "--formats", "usdc")
    return made / "hair.usdc"


def _run(*arguments: object) -> None:
    print("tress", *arguments, flush=True)
    subprocess.run([*_COMMAND, *map(str, arguments), "--quiet"], check=True)


def _picture(path: Path) -> np.ndarray:
    return np.asarray(Image.open(path).convert("RGB"))
