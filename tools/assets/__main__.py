"""`python -m tools.assets`: fetch the wheels, write `python/tress/head/data/`. The same bytes every time."""

from pathlib import Path

from tools.assets.head import write_head
from tools.assets.networks import write_networks
from tools.assets.provenance import write_provenance

ROOT = Path(__file__).parents[2]
CACHE = ROOT / ".stamps" / "wheels"
DATA = ROOT / "python" / "tress" / "head" / "data"


def main() -> None:
    """Builds every asset; under a minute on two cores, and the download of 70 MB the first time."""
    DATA.mkdir(parents=True, exist_ok=True)
    sources = write_networks(cache=CACHE, data=DATA)
    sources |= write_head(cache=CACHE, data=DATA)
    write_provenance(sources, data=DATA)


if __name__ == "__main__":
    main()
