"""The photographs that the pictures are made of: all in the public domain or CC0."""

import os
from pathlib import Path

from PIL import Image
from skimage import data

OPEN_DATA = Path(os.environ.get("TRESS_DATA", Path(__file__).parents[2].parent / "shared" / "data"))
ASTRONAUT = "astronaut"


def photo(name: str, folder: Path) -> Path | None:
    """The file of a photograph: `astronaut` (NASA, in scikit-image), else a number of the open portraits (CC0).

    None where the open portraits are absent.
    """
    if name == ASTRONAUT:
        path = folder / "astronaut.png"
        Image.fromarray(data.astronaut()).save(path)
        return path
    path = OPEN_DATA / "portraits" / f"{name}.jpg"
    return path if path.is_file() else None
