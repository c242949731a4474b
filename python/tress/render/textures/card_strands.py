"""The strands of one card as curves: roots in a row, gathered into locks that taper towards their tips.

Roots are spread evenly, each with a place in the thickness of the card. A strand follows the middle of its lock with an
offset that shrinks as the lock closes and turns slowly about the lock's middle, so that strands cross and cover each
other as in a real lock; smooth noise that grows from the root is its frizz. Strays follow nothing but their own drift.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.render.textures.card_kinds import CardKind
from tress.render.textures.params import TextureParams

Array = np.ndarray[Any, Any]
Generator = np.random.Generator

POINTS = 96
"""Points of a strand: eight a wave of the finest frizz."""
HALF_DEPTH = 0.15
"""Half of the card's thickness, in card widths; the depth map spans it."""
MARGIN = 0.03
"""What strands keep free at the left and right edge, in card widths."""
_WAVES = 6
_FRIZZ = 0.05
_EDGE_AIR = 0.45
"""How much wider than the mean roots stand apart at the card's edges, and narrower in its middle."""
_SHORTEST = 0.25


@dataclass(frozen=True, eq=False)
class CardStrands:
    """S strands of P points, root first, in the frame of a card.

    - `points` (S, P, 3) float64: x to the right from the left edge, y down from the root edge, z towards the viewer, in
      card widths
    - `t` (S, P): 0 at the root, 1 at the tip
    - `half_width` (S, P) in card widths, `opacity` (S, P)
    - `roll` (S, P): angle by which the strand's lock turns the surface to the side, radians
    - `lock` (S,) int64: the lock of every strand; strays have the lock they started beside
    """

    points: Array
    t: Array
    half_width: Array
    opacity: Array
    roll: Array
    lock: Array


@dataclass(frozen=True, eq=False)
class _Locks:
    """L locks: `x` (L, P) of their middles from the card's, `depth` (L,), `length` (L,), `radius` (L,) at the root."""

    x: Array
    depth: Array
    length: Array
    radius: Array


def card_strands(params: TextureParams, *, kind: CardKind, aspect: float, random: Generator) -> CardStrands:
    """Strands of a card of `aspect` (length over width) within [0, 1] x [0, aspect]."""
    count = max(round(params.strands * kind.density), 1)
    y = np.linspace(0, 1, POINTS)
    locks = _locks(params, kind, y, random)
    root = _roots(count, kind, random)
    lock = _nearest_lock(root, locks, random)
    root = root + kind.gathered * (locks.x[lock, 0] - root)
    length = _lengths(params, kind, locks.length[lock], random)
    t = np.broadcast_to(y, (count, POINTS))
    card_y = t * length[:, None]
    middle = _along(locks.x[lock], card_y)
    offset, offset_z = _offsets(params, kind, root - locks.x[lock, 0], card_y, random)
    stray = random.random(count) < kind.strays
    x = np.where(stray[:, None], _stray_paths(root, kind, card_y, random), middle + offset)
    wander = params.frizz * kind.frizz * np.where(stray, 1.6, 1.0)[:, None]
    x = x + wander * _frizz(card_y, aspect, random)
    z = locks.depth[lock][:, None] + offset_z + 0.5 * wander * _frizz(card_y, aspect, random)
    half_width, opacity = _profile(params, t, card_y, stray, random)
    roll = np.clip((middle - x) / locks.radius[lock][:, None], -1, 1) * np.where(stray, 0, 0.5)[:, None]
    points = np.stack([0.5 + _within(x), card_y * aspect, HALF_DEPTH * np.tanh(z / HALF_DEPTH)], axis=-1)
    return CardStrands(points, t, half_width, opacity, roll, lock)


def _locks(params: TextureParams, kind: CardKind, y: Array, random: Generator) -> _Locks:
    count = kind.locks
    slot = kind.spread / count
    root = -kind.spread / 2 + slot * (np.arange(count) + 0.5 + random.uniform(-0.3, 0.3, count))
    tip = root * kind.taper + kind.bend * random.normal(0, 0.5, count) + kind.bend * random.normal(0, 0.6)
    sway, phase = kind.bend * random.normal(0, 0.35, count), random.uniform(0, 2 * np.pi, count)
    way = y**1.5
    waves = np.sin(2 * np.pi * 0.8 * y + phase[:, None]) - np.sin(phase)[:, None]
    x = root[:, None] * (1 - way) + tip[:, None] * way + (sway[:, None] * waves) * y
    shorter = params.length_variation * kind.length_variation * random.random(count) ** 1.5
    shorter[random.integers(count)] = 0
    depth = random.permutation(np.linspace(-0.06, 0.06, count)) if count > 1 else np.zeros(1)
    return _Locks(x, depth, 1 - 0.6 * shorter, 0.7 * slot * random.uniform(0.8, 1.3, count))


def _roots(count: int, kind: CardKind, random: Generator) -> Array:
    """Spread from edge to edge, each at random within its share; sparser at the edges, so that cards end softly."""
    even = (np.arange(count) + random.random(count)) / count
    return kind.spread * (even + _EDGE_AIR * np.sin(2 * np.pi * even) / (2 * np.pi) - 0.5)


def _nearest_lock(root: Array, locks: _Locks, random: Generator) -> Array:
    """The lock that starts nearest, give or take, so that locks interlock at their borders."""
    seen_from = root + random.normal(0, 0.25, len(root)) * locks.radius.mean()
    return np.argmin(np.abs(seen_from[:, None] - locks.x[None, :, 0]), axis=1)


def _lengths(params: TextureParams, kind: CardKind, of_lock: Array, random: Generator) -> Array:
    """Most strands reach nearly the end of their lock, few are much shorter."""
    shorter = params.length_variation * kind.length_variation * random.random(len(of_lock)) ** 2.5
    return np.clip(of_lock * (1 - 0.7 * shorter) - 0.002, _SHORTEST, 0.998)


def _along(paths: Array, y: Array) -> Array:
    """Values (S, P) of `paths` (S, P), sampled evenly on [0, 1], at `y` (S, P)."""
    place = y * (paths.shape[1] - 1)
    first = np.minimum(place.astype(np.int64), paths.shape[1] - 2)
    rows, share = np.arange(len(paths))[:, None], place - first
    return paths[rows, first] * (1 - share) + paths[rows, first + 1] * share


def _offsets(
    params: TextureParams, kind: CardKind, from_middle: Array, y: Array, random: Generator
) -> tuple[Array, Array]:
    """Offsets (S, P) from the lock's middle, aside and towards the viewer: they turn, and shrink as the lock closes."""
    count = len(from_middle)
    thick = random.normal(0, 0.028, count)
    closing = np.clip(params.clumping * kind.clumping * random.normal(1, 0.12, count), 0, 0.97)[:, None]
    open_share = 1 - closing * _smooth(y, 0.05, 0.95)
    turn = random.normal(0.5, 0.5) * y * np.pi * 0.6 + random.normal(0, 0.3, count)[:, None] * y * np.pi
    aside, forward = from_middle[:, None], thick[:, None]
    return (
        open_share * (aside * np.cos(turn) - forward * np.sin(turn)),
        open_share * (forward * np.cos(turn) + 0.4 * aside * np.sin(turn)),
    )


def _stray_paths(root: Array, kind: CardKind, y: Array, random: Generator) -> Array:
    drift = random.normal(0, 0.12 + 0.5 * kind.bend, len(root))[:, None]
    return root[:, None] + drift * y**1.7


def _frizz(y: Array, aspect: float, random: Generator) -> Array:
    """Smooth noise (S, P) in card widths that grows from the root."""
    count, noise = len(y), np.zeros_like(y)
    for wave in range(1, _WAVES + 1):
        size = random.normal(0, 1, count)[:, None] / wave**1.3
        phase = random.uniform(0, 2 * np.pi, count)[:, None]
        noise += size * (np.sin(0.35 * wave * 2 * np.pi * y * aspect / 4 * 2 + phase) - np.sin(phase))
    return _FRIZZ * noise * y**0.6


def _profile(params: TextureParams, t: Array, y: Array, stray: Array, random: Generator) -> tuple[Array, Array]:
    """Half widths in card widths, and opacity: both fall over the tip, opacity rises over the root."""
    count = len(t)
    own = np.clip(np.exp(random.normal(0, 0.22, count)) * np.where(stray, 0.75, 1.0), 0.5, 1.8)[:, None]
    to_tip = (1 - t) / max(params.tip_fade, 1e-9)
    thin = 0.35 + 0.65 * np.clip(to_tip, 0, 1) ** 0.8
    fade = np.clip(2 * to_tip, 0, 1) if params.tip_fade else np.ones_like(t)
    begin = params.root_fade * random.random(count)[:, None]
    rise = np.clip((y - 0.5 * begin) / np.maximum(begin, 1e-9), 0, 1) if params.root_fade else np.ones_like(t)
    return 0.5 * params.thickness * own * (1 - 0.25 * t) * thin, fade * rise


def _within(x: Array) -> Array:
    """x bent back softly where it nears the card's edge."""
    half, bent = 0.5 - MARGIN, 0.88
    size = np.abs(x) / half
    over = bent + (1 - bent) * np.tanh((size - bent) / (1 - bent))
    return np.sign(x) * half * np.where(size < bent, size, over)


def _smooth(values: Array, low: float, high: float) -> Array:
    share = np.clip((values - low) / (high - low), 0, 1)
    return share * share * (3 - 2 * share)
