"""A hat differs from the hair below it by colour or by strands; short hair has nothing below to compare with."""

from dataclasses import replace

import numpy as np
import pytest

from tress.image.covering import covering
from tress.image.superpixels import Superpixels

COUNT = 10
ROOTED = np.arange(COUNT) < 5
HAIR = np.ones(COUNT, bool)


def patches(*, above: tuple[float, float, float], below: tuple[float, float, float]) -> Superpixels:
    """Ten patches of one area: five above the chin, five below."""
    lab = np.where(ROOTED[:, None], above, below).astype(np.float32)
    flat = np.zeros(COUNT, np.float32)
    return Superpixels(
        label=np.arange(COUNT, dtype=np.int32)[None],
        area=flat + 1,
        center=np.zeros((COUNT, 2), np.float32),
        lab=lab,
        texture=flat,
        grain=flat,
        edges=np.zeros((0, 2), np.int32),
        border=flat[:0],
    )


def evidence(found: Superpixels, *, strands: np.ndarray, hair: np.ndarray = HAIR) -> float:
    return covering(found, hair=hair, rooted=ROOTED, strands=strands)


def test_like_hair_above_and_below_is_no_covering() -> None:
    assert evidence(patches(above=(30, 5, 5), below=(30, 5, 5)), strands=np.full(COUNT, 0.4)) == 0


def test_the_evidence_is_the_step_of_colour() -> None:
    found = evidence(patches(above=(30, 5, 5), below=(60, 5, 45)), strands=np.zeros(COUNT))
    assert found == pytest.approx(50 / 22)


def test_cloth_above_strands_is_a_covering_of_any_colour() -> None:
    same = patches(above=(30, 5, 5), below=(30, 5, 5))
    assert evidence(same, strands=np.where(ROOTED, -1.0, 0.3)) == pytest.approx(1.3 / 0.65)
    assert evidence(same, strands=np.where(ROOTED, 0.3, -1.0)) == 0


def test_of_short_hair_nothing_is_said() -> None:
    found = patches(above=(30, 5, 5), below=(60, 5, 45))
    assert evidence(found, strands=np.zeros(COUNT), hair=ROOTED) == 0
    assert evidence(replace(found, area=np.where(ROOTED, 1, 0.2).astype(np.float32)), strands=np.zeros(COUNT)) == 0
    assert evidence(found, strands=np.zeros(COUNT), hair=~ROOTED) == 0
