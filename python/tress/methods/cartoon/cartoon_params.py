"""What can be said of any preset."""

from dataclasses import dataclass

from tress.base.params import Params, param


@dataclass(frozen=True)
class CartoonParams(Params):
    """Settings of every preset."""

    clumps: float = param(1.0, low=0.4, high=4.0, doc="Factor of the number of clumps; fewer are made wider.")
    length: float = param(1.0, low=0.5, high=2.0, doc="Factor of the length of what hangs.")
    pointiness: float = param(0.6, low=0.0, high=1.0, doc="Part of a clump's length that tapers.")
    seed: int = param(0, low=0, high=2**32 - 1, doc="Same preset, settings and seed: the same bits.")

    def count(self, hairs: int) -> int:
        """Key hairs of a surface that has so many by default."""
        return max(2, round(hairs * self.clumps))

    @property
    def widening(self) -> float:
        """Factor of the widths that keeps surfaces closed with this number of clumps."""
        return 1 / self.clumps
