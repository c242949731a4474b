"""The user's corrections from files, in pixels of the photo as the user has it, to those that the stages see."""

from dataclasses import dataclass
from pathlib import Path

from tress.methods.portrait.corrections import Corrections


@dataclass(frozen=True)
class CorrectionFiles:
    """Files and choices of the user; None where nothing was given."""

    face: int | None = None
    landmarks: Path | None = None
    strokes: Path | None = None
    depth_strokes: Path | None = None


def read_corrections(files: CorrectionFiles) -> Corrections:
    """The corrections in `files`. Raises `InputError` where a file cannot be used."""
    return Corrections(face=files.face)
