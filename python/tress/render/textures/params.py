"""What the strands of an atlas look like, and how large it is."""

from dataclasses import dataclass

import numpy as np

from tress.base.errors import ParameterError
from tress.base.params import Params, param
from tress.render.textures.card_kinds import KINDS

Color = tuple[float, float, float]

DEFAULT_KINDS = ("core", "core", "layered", "layered", "fringe", "wispy", "wispy", "flyaway")


@dataclass(frozen=True)
class TextureParams(Params):
    """Settings of `strand_atlas`. Lengths are in widths of a card, so that they mean the same at any resolution.

    `kinds` are stretched over the variations from first to last: two kinds and eight variations give four of each.
    Colours are linear light. Raises `ParameterError` for values out of range, unknown kinds, and a resolution that is
    no power of two.
    """

    strands: int = param(280, low=1, high=4000, doc="Strands of the densest card; other kinds have a share of them.")
    thickness: float = param(0.01, low=0.001, high=0.2, unit="card widths", doc="Width of a strand at its root.")
    clumping: float = param(0.6, low=0, high=1, doc="How much strands gather into locks towards the tip.")
    frizz: float = param(0.3, low=0, high=1, doc="How far single strands wander from their lock.")
    tip_fade: float = param(0.25, low=0, high=1, doc="Share of a strand over which it thins and fades at the tip.")
    root_fade: float = param(0.025, low=0, high=0.5, doc="Share of the card over which strands appear at the root.")
    length_variation: float = param(0.35, low=0, high=1, doc="How much shorter the shortest strands are.")
    root_color: Color = (0.0242, 0.0110, 0.0056)
    tip_color: Color = (0.1529, 0.0685, 0.0284)
    color_variation: float = param(0.4, low=0, high=1, doc="How much strands differ in brightness and hue.")
    depth_shading: float = param(0.6, low=0, high=1, doc="How much darker strands are that lie deep in the card.")
    variations: int = param(8, low=1, high=256, doc="Cards in the atlas.")
    kinds: tuple[str, ...] = DEFAULT_KINDS
    resolution: int = param(2048, low=64, high=8192, unit="px", doc="Width of the atlas, a power of two.")
    aspect: float = param(
        4.0, low=0.25, high=32, doc="Length of a card over its width; met as nearly as the atlas allows."
    )
    padding: int = param(16, low=1, high=256, unit="px", doc="Empty border around every card.")
    threshold: float = param(0.5, low=0.01, high=0.99, doc="Alpha test at which the mip chain keeps its coverage.")
    seed: int = param(0, low=0, high=2**32 - 1, doc="Same parameters and seed: the same bits.")

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("root_color", "tip_color"):
            _check_color(name, getattr(self, name))
        if self.resolution & (self.resolution - 1):
            raise ParameterError(f"resolution is {self.resolution}; a power of two was expected, such as 2048.")
        if not self.kinds:
            raise ParameterError("kinds is empty; at least one kind of card was expected.")
        for kind in self.kinds:
            if kind not in KINDS:
                raise ParameterError(f"kinds names {kind!r}; one of {', '.join(KINDS)} was expected.")

    def kind_of(self, variation: int) -> str:
        """The kind of card of a variation."""
        return self.kinds[variation * len(self.kinds) // self.variations]


def _check_color(name: str, color: Color) -> None:
    values = np.asarray(color)
    if values.shape != (3,) or values.dtype.kind not in "fiu" or not ((values >= 0) & (values <= 1)).all():
        raise ParameterError(f"{name} is {color!r}; three numbers from 0 to 1 were expected, linear light.")
