"""Fewer and wider strands for small pictures, which look the same."""

from dataclasses import replace
from typing import Any

import numpy as np

from tress.render.flat_scene import FlatScene

Array = np.ndarray[Any, Any]

_GOLDEN = 0.6180339887498949


def simplified(scene: FlatScene, *, most_strands: int) -> FlatScene:
    """The scene with at most about `most_strands` strands, each wider by as much as there are fewer of them.

    Strands are left out evenly (golden-ratio sequence of their numbers), the same ones for the same scene. What hair
    covers stays the same on the whole, and pictures in which a strand is narrower than a pixel hardly change; closer
    ones show coarser strands. Source: Cook, Halstead, Planck, Ryu 2007, stochastic simplification.
    """
    count = len(scene.offsets) - 1
    share = most_strands / max(count, 1)
    if share >= 1:
        return scene
    strands = np.flatnonzero((np.arange(count) * _GOLDEN) % 1.0 < share)
    lengths = np.diff(scene.offsets)[strands]
    offsets = np.concatenate([np.zeros(1, np.int64), np.cumsum(lengths)])
    kept = np.arange(offsets[-1]) + np.repeat(scene.offsets[strands] - offsets[:-1], lengths)
    return replace(
        scene,
        points=scene.points[kept],
        offsets=offsets,
        color=scene.color[kept],
        alpha=scene.alpha[kept],
        radius=scene.radius[kept] * np.float32(count / max(len(strands), 1)),
        tangent=None if scene.tangent is None else scene.tangent[kept],
        sky=None if scene.sky is None else scene.sky[kept],
    )
