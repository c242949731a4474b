"""Print the requirements of pyproject.toml, with the extras named on the command line; `--lowest` pins lower bounds."""

import re
import sys
import tomllib
from pathlib import Path

PROJECT = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text())["project"]


def requirements(extras: list[str]) -> list[str]:
    """The package's requirements followed by those of each extra, in the order of the file."""
    optional = PROJECT["optional-dependencies"]
    return PROJECT["dependencies"] + [line for extra in extras for line in optional[extra]]


def lowest(requirement: str) -> str:
    """The requirement pinned to its lower bound."""
    return re.sub(r">=([^,]+).*", r"==\1", requirement)


if __name__ == "__main__":
    names = [name for name in sys.argv[1:] if not name.startswith("--")]
    lines = requirements(names)
    print("\n".join(map(lowest, lines) if "--lowest" in sys.argv else lines))
