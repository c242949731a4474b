"""Runs of `tress portrait`, as a user would start them, and what lies in their folders afterwards."""

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from tress.image.labels import FACE, HAIR
from tress.io.record_file import load_record

_COMMAND = (sys.executable, "-c", "from tress.app.cli import main; main()")
_AIR = 0.15


@dataclass(frozen=True)
class Run:
    """A photograph and the folder of its results."""

    photo: Path
    folder: Path

    def again(self, *options: object) -> None:
        """Runs the command into the folder; no film, no formats. Raises `CalledProcessError`."""
        usual = ("--no-turntable", "--formats", "", "--quiet")
        arguments = ("portrait", self.photo, "-o", self.folder, *usual, *options)
        print("tress", *arguments, flush=True)
        subprocess.run([*_COMMAND, *map(str, arguments)], check=True)

    def picture(self, name: str) -> np.ndarray[Any, Any]:
        """A picture of the folder, (H, W, 3) uint8."""
        return np.asarray(Image.open(self.folder / name).convert("RGB"))

    def stage_picture(self, stage: str) -> np.ndarray[Any, Any]:
        """The picture of a stage, whole."""
        return self.picture(str(next(self.folder.glob(f"stages/*_{stage}.png")).relative_to(self.folder)))

    def stage_panels(self, stage: str, *, box: tuple[slice, slice]) -> list[np.ndarray[Any, Any]]:
        """The picture of a stage cut to `box`, once for every time that the photo's frame stands in it."""
        picture = self.stage_picture(stage)
        height, width = self.frame
        if picture.shape[0] != height:
            return [picture]
        panels = np.split(picture, picture.shape[1] // width, axis=1)
        return [panel[box] for panel in panels]

    @property
    def frame(self) -> tuple[int, int]:
        """Height and width of the photograph as the stages see it."""
        return self._label.shape

    def head_box(self) -> tuple[slice, slice]:
        """Rows and columns around hair and face."""
        shown = np.isin(self._label, (FACE, HAIR))
        sides = []
        for axis in (1, 0):
            within = np.flatnonzero(shown.any(axis=axis))
            air = round(_AIR * (within[-1] - within[0]))
            sides.append(slice(max(0, within[0] - air), within[-1] + air))
        return sides[0], sides[1]

    @property
    def _label(self) -> np.ndarray[Any, Any]:
        layers, _ = load_record(self.folder / "stages" / "02_layers.npz")
        return layers.label


def first_run(photo: Path, folder: Path, *options: object) -> Run:
    """The run into a folder of the photograph's name, as it is where it was made before."""
    run = Run(photo, folder / photo.stem)
    if not run.folder.exists():
        run.again(*options)
    return run
