"""Where the open data lies: the folder named by TRESS_DATA, or `shared/data` beside the checkout."""

import importlib.util
import os
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).parents[1]
OPEN_DATA = Path(os.environ.get("TRESS_DATA", ROOT.parent / "shared" / "data"))


def portraits() -> list[Path]:
    """The open portraits, sorted by name; empty where the data is absent."""
    return sorted((OPEN_DATA / "portraits").glob("*.jpg"))


def synthetic_cases() -> list[Path]:
    """Folders of the rendered cases with known truth; empty where the data is absent."""
    return sorted(path.parent for path in (OPEN_DATA / "synthetic").glob("*/truth.npz"))


def scorer() -> ModuleType:
    """The scorer that comes with the rendered cases."""
    spec = importlib.util.spec_from_file_location("score", OPEN_DATA / "synthetic" / "score.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
