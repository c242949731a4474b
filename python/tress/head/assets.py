"""Where the built assets of the head lie: three networks, the statistical head, and a note of their sources."""

from pathlib import Path

from tress.base.errors import AssetMissingError

DATA = Path(__file__).parent / "data"


def asset(name: str) -> Path:
    """The path of the built asset `name`.

    Raises `AssetMissingError` where it has not been built; the message says how to build it.
    """
    path = DATA / name
    if not path.is_file():
        raise AssetMissingError(f"The asset {name} is missing from {DATA}; run `make assets` to build it.")
    return path
