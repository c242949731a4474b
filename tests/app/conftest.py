"""The command line run inside the test, with what it said and its exit code."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tress.app.cli import app


@dataclass(frozen=True)
class Said:
    """How a command ended: exit code, standard output, standard error."""

    code: int
    out: str
    err: str


@pytest.fixture
def tress(capsys) -> Callable[..., Said]:
    """`tress("portrait", path, "-o", folder)`."""

    def run(*arguments: object) -> Said:
        with pytest.raises(SystemExit) as caught:
            app([str(argument) for argument in arguments])
        shown = capsys.readouterr()
        return Said(int(caught.value.code or 0), shown.out, shown.err)

    return run


@pytest.fixture(scope="session")
def astronaut() -> Image.Image:
    """A portrait in the public domain: head and shoulders, 320 x 320 px."""
    from skimage import data

    return Image.fromarray(data.astronaut()).crop((75, 0, 395, 320))


@pytest.fixture(scope="session")
def faceless() -> Image.Image:
    """Smooth noise: a picture of nothing."""
    noise = np.random.default_rng(0).random((24, 24, 3))
    return Image.fromarray((noise * 255).astype(np.uint8)).resize((256, 256), Image.Resampling.BICUBIC)


def everything_below(folder: Path) -> list[Path]:
    """All files and folders below `folder`, hidden ones too."""
    return sorted(folder.rglob("*"))
