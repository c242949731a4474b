"""A ball for a head and a cap of hair on it, small enough for quick tests."""

from dataclasses import dataclass, field

import numpy as np

from tress.base.report import Report
from tress.methods.portrait.depth import StrandDepths, depth
from tress.methods.portrait.grow import GrownHair, GrowParams, grow
from tress.methods.portrait.inside_outline import SOLID_ALPHA
from tress.methods.portrait.volume import HairVolume, volume

RADIUS = 0.09
SCALE = 600.0
SIZE = 200


@dataclass(frozen=True)
class Ball:
    """A ball of `RADIUS` metres, its upper half scalp; the photo has 600 px a metre."""

    positions_in_view: np.ndarray
    triangles: np.ndarray
    masks: dict[str, np.ndarray]
    xy_from_view: np.ndarray
    view_from_head: np.ndarray = field(default_factory=lambda: np.eye(4))


@dataclass(frozen=True)
class Curves:
    """Traced strands."""

    points: np.ndarray
    offsets: np.ndarray
    occluded: np.ndarray


def ball() -> Ball:
    """The head."""
    rows, columns = 24, 48
    polar, round_ = np.linspace(0.01, np.pi - 0.01, rows), np.arange(columns) / columns * 2 * np.pi
    x = np.outer(np.sin(polar), np.sin(round_))
    z = np.outer(np.sin(polar), np.cos(round_))
    y = np.outer(np.cos(polar), np.ones(columns))
    points = RADIUS * np.stack([x, y, z], axis=-1).reshape(-1, 3)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(rows - 1), np.arange(columns), indexing="ij"))
    a, b = i * columns + j, i * columns + (j + 1) % columns
    triangles = np.concatenate([np.stack([a, a + columns, b], 1), np.stack([b, a + columns, b + columns], 1)])
    matrix = np.array([[SCALE, 0, 0, SIZE / 2], [0, -SCALE, 0, SIZE / 2], [0, 0, 0, 1.0]])
    return Ball(points, triangles.astype(np.int32), {"scalp": (points[:, 1] > 0.02).astype(np.float32)}, matrix)


def hair_alpha(thickness: float = 0.012) -> np.ndarray:
    """(H, W): hair above the brow, `thickness` metres thick at the outline."""
    y, x = (
        (SIZE / 2 - (np.mgrid[:SIZE, :SIZE] + 0.5)[0]) / SCALE,
        ((np.mgrid[:SIZE, :SIZE] + 0.5)[1] - SIZE / 2) / SCALE,
    )
    return ((np.hypot(x, y) < RADIUS + thickness) & (y > 0.04)).astype(np.float32)


def curves() -> Curves:
    """Strands that run from the top to the sides."""
    starts = np.linspace(30, 170, 40)
    along = np.arange(20) * 1.5
    points = np.stack(
        [starts[:, None] + 0.3 * along * np.sign(starts - 100)[:, None], 45 + along + 0 * starts[:, None]], -1
    )
    return Curves(points.reshape(-1, 2).astype(np.float32), np.arange(41) * 20, np.zeros(800, bool))


def long_alpha(edges: tuple[float, float] = (-0.15, -0.15)) -> np.ndarray:
    """(H, W): the cap, and hair that hangs at either side down to `edges` metres."""
    y = (SIZE / 2 - (np.mgrid[:SIZE, :SIZE] + 0.5)[0]) / SCALE
    x = ((np.mgrid[:SIZE, :SIZE] + 0.5)[1] - SIZE / 2) / SCALE
    side = (np.abs(x) > 0.075) & (np.abs(x) < RADIUS + 0.012) & (y < 0.05) & (y > np.where(x < 0, *edges))
    return np.maximum(hair_alpha(), side).astype(np.float32)


def solid_pixels(alpha: np.ndarray | None = None) -> np.ndarray:
    """(H, W) bool: the ball without hair."""
    hair = hair_alpha() if alpha is None else alpha
    y, x = (np.mgrid[:SIZE, :SIZE] + 0.5 - SIZE / 2) / SCALE
    return (np.hypot(x, y) < RADIUS) & (hair < 0.5)


def small_depths(
    strokes: np.ndarray | None = None, report: Report | None = None, alpha: np.ndarray | None = None
) -> StrandDepths:
    """Depths of the curves."""
    return depth(
        curves(),
        head=ball(),
        alpha=hair_alpha() if alpha is None else alpha,
        solid=solid_pixels(alpha),
        depth_strokes=strokes,
        report=report or Report(),
    )


def small_volume(alpha: np.ndarray | None = None) -> HairVolume:
    """Volume of the cap, or of the hair that `alpha` shows."""
    stripes = 0.5 + 0.3 * np.sin(np.mgrid[:SIZE, :SIZE][1] * 1.3)
    return volume(
        small_depths(alpha=alpha),
        traced=curves(),
        brightness=stripes,
        alpha=hair_alpha() if alpha is None else alpha,
        head=ball(),
        report=Report(),
    )


def small_hair(volume_: HairVolume, report: Report, seed: int = 0, alpha: np.ndarray | None = None) -> GrownHair:
    """Some strands of the cap."""
    color = np.full((SIZE, SIZE, 3), 0.2, np.float32)
    shown = hair_alpha() if alpha is None else alpha
    return grow(
        volume_,
        foreground=color,
        alpha=shown,
        before=(shown > SOLID_ALPHA) | solid_pixels(alpha),
        skin=np.zeros(shown.shape, np.bool_),
        head=ball(),
        params=GrowParams(count=3000),
        seed=seed,
        report=report,
    )
