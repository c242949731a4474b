"""The kinds of card that a hairdo is built from: dense ones first, on them ever sparser ones."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True)
class CardKind:
    """How one kind of card differs from the densest. Shares, and factors on the parameters of the same name."""

    density: float
    """Share of the strands."""
    locks: int
    """Locks that the strands gather in."""
    spread: float
    """Share of the card's width that roots fill."""
    gathered: float
    """How much roots already gather in their locks, 0 evenly spread to 1."""
    taper: float
    """Width of all locks at the tip over that at the root."""
    clumping: float
    frizz: float
    length_variation: float
    strays: float
    """Share of the strands that belong to no lock."""
    bend: float
    """How far locks drift aside on their way, in card widths."""


KINDS: Final[Mapping[str, CardKind]] = {
    "core": CardKind(
        1.0, 12, 0.98, gathered=0.0, taper=0.94, clumping=0.7, frizz=0.7, length_variation=0.6, strays=0.04, bend=0.05
    ),
    "layered": CardKind(
        0.55, 8, 0.92, gathered=0.15, taper=0.82, clumping=1.0, frizz=0.9, length_variation=1.0, strays=0.06, bend=0.09
    ),
    "fringe": CardKind(
        0.34, 7, 0.95, gathered=0.3, taper=0.98, clumping=1.2, frizz=0.6, length_variation=0.45, strays=0.05, bend=0.05
    ),
    "wispy": CardKind(
        0.19, 4, 0.75, gathered=0.55, taper=0.8, clumping=1.0, frizz=1.2, length_variation=1.2, strays=0.16, bend=0.14
    ),
    "flyaway": CardKind(
        0.06, 4, 0.8, gathered=0.5, taper=1.0, clumping=0.6, frizz=2.0, length_variation=1.3, strays=0.6, bend=0.18
    ),
}
