"""Random heads from MakeHuman's morph targets, each modifier scaled by the millimetres it moves the skin.

Equal weights for all modifiers would give cone heads: some move a nostril by a millimetre, others the crown by three
centimetres. Every modifier is a pair of opposite targets (or one alone); its weight is normal with the standard
deviation that moves the skin by `SPREAD_M` of its folder where it moves it most. Left and right go together but not
quite. These are artists' targets, not scans: the spread is plausible, not measured.
"""

import re
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tools.assets.cut import HeadCut
from tools.assets.makehuman import MakeHuman, on_vertices

SPREAD_M: Mapping[str, float] = {
    "head": 3.2e-3,
    "forehead": 2.2e-3,
    "cheek": 1.6e-3,
    "chin": 2.0e-3,
    "ears": 1.8e-3,
    "eyes": 0.8e-3,
    "eyebrows": 1.3e-3,
    "nose": 1.3e-3,
    "mouth": 0.9e-3,
    "neck": 4.5e-3,
    "asym": 0.5e-3,
}
EXCLUDED = ("forehead-nubian", "ear-shape-pointed")
SIDES_TOGETHER = 0.95
"""Correlation of the left and the right modifier of a pair."""
OPPOSITES = {
    "incr": "decr",
    "up": "down",
    "out": "in",
    "forward": "backward",
    "convex": "concave",
    "uncompress": "compress",
}


def random_heads(source: MakeHuman, cut: HeadCut, *, count: int, seed: int) -> NDArray[np.float32]:
    """`count` heads as positions (count, V, 3) float32 metres, not aligned. Deterministic."""
    rng = np.random.default_rng(seed)
    names, offsets = _stacked(source, cut)
    weights = _macro_weights(names, count, rng) + _local_weights(names, offsets, count, rng)
    moved = weights.astype(np.float32) @ offsets.reshape(len(names), -1)
    return source.mesh.positions[cut.vertices].astype(np.float32) + moved.reshape(count, -1, 3)


def _stacked(source: MakeHuman, cut: HeadCut) -> tuple[list[str], NDArray[np.float32]]:
    """Names and offsets (T, V, 3) of all targets that move the head."""
    names, offsets = [], []
    for name, target in source.targets.items():
        folder = name.split("/")[0]
        wanted = folder in SPREAD_M or re.fullmatch(r"macrodetails/[^/]+", name)
        if not wanted or any(word in name for word in EXCLUDED):
            continue
        here = on_vertices(target, cut.vertices, len(source.mesh.positions))
        if np.abs(here).max(initial=0) > 1e-4:
            names.append(name)
            offsets.append(here.astype(np.float32))
    return names, np.stack(offsets)


def _macro_weights(names: list[str], count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Weights (count, T) of the targets for gender, age, ancestry, muscle and weight: products of their factors."""
    male = rng.beta(0.4, 0.4, count)
    age = np.where(rng.random(count) < 0.12, rng.uniform(0.25, 0.5, count), rng.uniform(0.5, 1.0, count))
    ancestry = rng.dirichlet([0.45] * 3, count)
    factors = {"male": male, "female": 1 - male}
    factors |= dict(zip(("african", "asian", "caucasian"), ancestry.T, strict=True))
    factors |= _between(("child", "young", "old"), (0.1875, 0.5, 1.0), age)
    for trait, mean in (("muscle", 0.5), ("weight", 0.5)):
        value = np.clip(rng.normal(mean, 0.2, count), 0, 1)
        factors |= _between((f"min{trait}", f"average{trait}", f"max{trait}"), (0.0, 0.5, 1.0), value)
    weights = np.zeros((count, len(names)))
    for column, name in enumerate(names):
        if name.startswith("macrodetails/"):
            words = name.removeprefix("macrodetails/").removeprefix("universal-").split("-")
            weights[:, column] = np.prod([factors.get(word, np.zeros(count)) for word in words], axis=0)
    return weights


def _between(names: tuple[str, ...], knots: tuple[float, ...], value: NDArray[np.float64]) -> dict[str, NDArray]:
    """Hat functions of `value` at `knots`, by name."""
    return {name: np.interp(value, knots, np.eye(len(knots))[k]) for k, name in enumerate(names)}


def _local_weights(
    names: list[str], offsets: NDArray[np.float32], count: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Weights (count, T) of the local modifiers."""
    weights = np.zeros((count, len(names)))
    shared: dict[str, NDArray[np.float64]] = {}
    own: dict[str, NDArray[np.float64]] = {}
    for column, name in enumerate(names):
        folder = name.split("/")[0]
        if folder not in SPREAD_M:
            continue
        modifier, sign = _modifier(name)
        both = re.sub(r"/[lr]-", "/", modifier)
        if both not in shared:
            shared[both] = rng.standard_normal(count)
        if modifier not in own:
            alone = np.sqrt(1 - SIDES_TOGETHER**2) * rng.standard_normal(count)
            own[modifier] = shared[both] if both == modifier else SIDES_TOGETHER * shared[both] + alone
        weights[:, column] = np.maximum(sign * own[modifier], 0) * SPREAD_M[folder] / _moved(offsets[column])
    return weights


def _modifier(name: str) -> tuple[str, int]:
    """The modifier that a target belongs to, and which of its two ends it is."""
    stem, _, end = name.rpartition("-")
    if end in OPPOSITES:
        return stem, 1
    if end in OPPOSITES.values():
        return stem, -1
    return name, 1


def _moved(offsets: NDArray[np.float32]) -> float:
    """How far a target moves the skin where it moves it most, metres."""
    return float(np.linalg.norm(offsets, axis=1).max())
