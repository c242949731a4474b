"""Fixtures that every test may ask for."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

# A check before a change lands draws the same examples every time; `make test-full` draws new ones.
settings.register_profile("same every time", derandomize=True)
settings.load_profile("same every time")

collect_ignore = ["blender_import.py"]  # run by Blender
ROOT = Path(__file__).parents[1]
OPEN_DATA = Path(os.environ.get("TRESS_DATA", ROOT.parent / "shared" / "data"))


@pytest.fixture(scope="session")
def open_data() -> Callable[[str], Path]:
    """`open_data("portraits/001.jpg")`: a file of the open data; the test skips where it is absent."""

    def path(name: str) -> Path:
        if not (OPEN_DATA / name).exists():
            pytest.skip(f"open data {name} is absent")
        return OPEN_DATA / name

    return path
