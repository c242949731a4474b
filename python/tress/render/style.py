"""What a style is."""

from typing import Any, ClassVar, Protocol, runtime_checkable

import numpy as np

from tress.render.gbuffer import GBuffer

Array = np.ndarray[Any, Any]


class Style(Protocol):
    """Settings that can shade a GBuffer: a frozen `Params` dataclass with the `name` that users call it."""

    name: ClassVar[str]

    def shade(self, gbuffer: GBuffer) -> Array:
        """(F, 4) float32: linear colour, not premultiplied, and opacity of every fragment; a fresh array."""
        ...


@runtime_checkable
class LineStyle(Protocol):
    """A style that also draws lines, which lie over the shaded picture and beyond its silhouette."""

    def drawn_lines(self, gbuffer: GBuffer) -> Array:
        """(H, W, 4) float32 linear, premultiplied."""
        ...
