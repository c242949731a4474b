"""What can be said of key hairs and of the clumps around them."""

from dataclasses import dataclass

from tress.base.params import Params, choice, param


@dataclass(frozen=True)
class KeyHairParams(Params):
    """How key hairs are taken from a surface. Along a surface runs u, across it v."""

    hairs: int = param(12, low=2, high=100_000, doc="n: key hairs of a surface.")
    points: int = param(16, low=4, high=1000, doc="p: control points of a key hair; more than 3.")
    length: float = param(1.0, low=0.0, high=1.0, doc="Part of the surface's length that hairs have (hairLength).")
    along: str = choice("u", options=("u", "v"), doc="Which parameter of the surface runs along the hair.")
    root: str = choice("first", options=("first", "last"), doc="At which end of that parameter the roots are.")
    side: str = choice("front", options=("front", "back"), doc="To which side of the surface its normals point.")
    jitter: float = param(0.0, low=0.0, high=1.0, doc="Random shift between hairs, as part of their spacing.")
    seed: int = param(0, low=0, high=2**32 - 1, doc="Same surface, settings and seed: the same bits.")


@dataclass(frozen=True)
class ClumpParams(Params):
    """The shape that is swept along a key hair."""

    vertical_radius: float = param(0.006, low=1e-6, high=1e3, unit="m", doc="Radius along the normal (vertRadius).")
    horizontal_radius: float = param(0.012, low=1e-6, high=1e3, unit="m", doc="Radius across it (horizRadius).")
    pointiness: float = param(0.5, low=0.0, high=1.0, doc="Part of the length that tapers: 0 a flat end, 1 all of it.")
