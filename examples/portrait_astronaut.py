"""The whole way from a photograph to files: `python examples/portrait_astronaut.py [FOLDER]`, or `make demo`.

The photograph is scikit-image's `astronaut` (Eileen Collins; NASA, public domain).
"""

import sys
import tempfile
from pathlib import Path

from PIL import Image
from skimage import data

from tress.app.cli import main


def demo(folder: Path) -> None:
    """Runs `tress portrait` on the astronaut; the results are in `folder` afterwards."""
    with tempfile.TemporaryDirectory() as temporary:
        photo = Path(temporary) / "astronaut.png"
        Image.fromarray(data.astronaut()).save(photo)
        sys.argv = ["tress", "portrait", str(photo), "-o", str(folder)]
        main()


if __name__ == "__main__":
    demo(Path(sys.argv[1] if len(sys.argv) > 1 else "out/demo"))
