"""What can be said of any preset."""

from dataclasses import dataclass

from tress.base.params import Params, param

USUAL = 400
"""Strips for which the widths in the presets are meant."""


@dataclass(frozen=True)
class StripsParams(Params):
    """Settings of every preset."""

    strips: int = param(USUAL, low=60, high=5000, doc="About how many strips; fewer are made wider.")
    length: float = param(1.0, low=0.3, high=3, doc="Factor of the preset's length.")
    seed: int = param(0, low=0, high=2**32 - 1, doc="Same preset, settings and seed: the same bits.")

    def count(self, share: float) -> int:
        """Strips of a layer with this share of them."""
        return max(1, round(share * self.strips))

    @property
    def widening(self) -> float:
        """Factor of the widths that keeps the head covered with this number of strips."""
        return (USUAL / self.strips) ** 0.5
