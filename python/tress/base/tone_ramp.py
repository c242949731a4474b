"""A one-dimensional ramp of flat tones over the cosine of the light: what cel shading looks its tones up in.

Source: Lake et al., Stylized Rendering Techniques for Scalable Real-Time 3D Animation (2000): hard shading, here with
any number of tones, a highlight above them and a lowlight below.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.params import Params, param

Array = np.ndarray[Any, Any]

_COOL = np.array([0.72, 0.86, 1.35])
"""What the shade turns to where it is cool: less red, more blue, about as bright."""


@dataclass(frozen=True)
class ToneParams(Params):
    """Tones of a surface, from where it faces the light to where it turns away. Edges are cosines of that angle."""

    tones: int = param(2, low=1, high=16, doc="Number of flat tones between light and shade.")
    edge: float = param(0.12, low=-1, high=1, doc="Cosine to the light at which the darkest tone begins.")
    spread: float = param(0.35, low=0.01, high=2, doc="Cosines over which more than two tones are spread.")
    shade: float = param(0.42, low=0, high=1, doc="Brightness of the darkest tone, as a part of the colour.")
    cool: float = param(0.35, low=0, high=1, doc="How far the shade turns from warm to blue.")
    highlight: float = param(1.0, low=0, high=1, doc="Cosine from which on there is a highlight; 1 is none.")
    gleam: float = param(0.4, low=0, high=1, doc="How far highlights go from the colour to white.")
    lowlight: float = param(-1.0, low=-1, high=1, doc="Cosine below which there is a lowlight; -1 is none.")
    depth: float = param(0.5, low=0, high=1, doc="Brightness of the lowlight, as a part of the darkest tone.")


@dataclass(frozen=True, eq=False)
class ToneRamp:
    """Tones between `edges` (K,) ascending: tone k is `factor[k]` (K + 1, 3) times the colour, brightened by
    `gleam[k]` (K + 1,), see `gleaming`."""

    edges: Array
    factor: Array
    gleam: Array

    def of(self, color: Array, cosine: Array, *, slope: Array | float = 0.0) -> Array:
        """(N, 3) float32: tones of colours (N, 3) or (3,) at cosines (N,).

        `slope` (N,) is how much the cosine changes within a pixel: an edge that crosses one is shown by shares of it.
        """
        tones = [
            gleaming(np.asarray(color, np.float32) * factor.astype(np.float32), gleam=float(gleam))
            for factor, gleam in zip(self.factor, self.gleam, strict=True)
        ]
        out = np.broadcast_to(tones[0], (len(cosine), 3)).copy()
        for k, edge in enumerate(self.edges):
            out += above(cosine - edge, slope)[:, None].astype(np.float32) * (tones[k + 1] - tones[k])
        return out


def tone_ramp(params: ToneParams) -> ToneRamp:
    """The ramp of these settings.

    >>> ramp = tone_ramp(ToneParams(tones=2, edge=0.0, shade=0.5, cool=0.0))
    >>> ramp.of(np.ones(3), np.array([-0.1, 0.1]))[:, 0].tolist()
    [0.5, 1.0]
    """
    steps = params.tones - 1
    edges = [params.edge + params.spread * k / max(steps - 1, 1) for k in range(steps)]
    light = np.linspace(0, 1, params.tones) if steps else np.ones(1)
    darkest = params.shade * (1 + params.cool * (_COOL - 1))
    factor = [share + (1 - share) * darkest for share in light]
    gleam = [0.0] * params.tones
    if params.lowlight > -1:
        edges, factor, gleam = [params.lowlight, *edges], [factor[0] * params.depth, *factor], [0.0, *gleam]
    if params.highlight < 1:
        edges, factor, gleam = [*edges, params.highlight], [*factor, np.ones(3)], [*gleam, params.gleam]
    return ToneRamp(np.maximum.accumulate(np.array(edges, np.float64)), np.array(factor), np.array(gleam))


def gleaming(color: Array, *, gleam: float) -> Array:
    """Linear colours brightened in their own hue: 0 is the colour, 1 is white.

    >>> gleaming(np.array([0.25, 0.0625]), gleam=0.5).tolist()
    [0.5, 0.25]
    """
    return color if gleam == 0 else np.maximum(color, 1e-4) ** (1 - gleam)


def above(value: Array, slope: Array | float) -> Array:
    """(N,) in [0, 1]: the share of a pixel in which a value is above 0 that is `value` in its middle.

    >>> above(np.array([-1.0, 0.0, 0.25, 1.0]), 1.0).tolist()
    [0.0, 0.5, 0.75, 1.0]
    """
    return np.clip(np.asarray(value, np.float64) / np.maximum(slope, 1e-9) + 0.5, 0, 1)
