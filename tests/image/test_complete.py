"""Completion: repeated patterns come back, what is known stays, the seed decides."""

import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tress.base.errors import InputError
from tress.image.complete import CompleteParams, complete


def checks(size=64, period=8):
    y, x = np.mgrid[:size, :size]
    value = ((x // (period // 2) + y // (period // 2)) % 2).astype(np.float32)
    return np.stack([value, 1 - value, np.full_like(value, 0.25)], axis=-1)


def square_hole(size=64, start=24, side=14):
    hole = np.zeros((size, size), bool)
    hole[start : start + side, start : start + side] = True
    return hole


def test_a_periodic_pattern_is_restored():
    pattern, hole = checks(), square_hole()
    filled = complete(np.where(hole[..., None], np.nan, pattern), hole=hole)
    assert np.abs(filled - pattern)[hole].mean() < 0.02


def test_known_pixels_keep_their_bits_and_filled_ones_lie_among_the_source():
    picture = np.random.default_rng(0).random((40, 50, 3)).astype(np.float32)
    hole = np.zeros((40, 50), bool)
    hole[:12, 30:] = True
    filled = complete(picture, hole=hole)
    assert (filled[~hole] == picture[~hole]).all()
    assert filled[hole].min() >= picture[~hole].min()
    assert filled[hole].max() <= picture[~hole].max()


def test_only_the_source_is_copied():
    picture = np.zeros((48, 48, 1), np.float32)
    picture[:, 24:] = 1
    source = np.zeros((48, 48), bool)
    source[:, 30:] = True
    hole = square_hole(48, 4, 10)
    assert (complete(picture, hole=hole, source=source)[hole] == 1).all()


def test_the_guide_chooses_between_two_materials():
    picture = np.zeros((60, 60, 1), np.float32)
    picture[:, 30:] = 1
    hole = np.zeros((60, 60), bool)
    hole[20:40, 15:45] = True
    guide = 4 * picture
    guide[20:40, 22:] = 4.0
    filled = complete(picture, hole=hole, guide=guide, source=~hole)
    wanted = (guide[..., 0] > 2).astype(np.float32)
    # The border between the materials moves from column 30 to 22, give or take half a patch.
    assert np.abs(filled[..., 0] - wanted)[24:36, 26:45].mean() < 0.05
    assert np.abs(filled[..., 0] - wanted)[24:36, 15:19].mean() < 0.05


def test_no_hole_changes_nothing():
    picture = checks()
    assert (complete(picture, hole=np.zeros((64, 64), bool)) == picture).all()


def test_small_sources_take_smaller_patches_and_none_is_refused():
    picture, source = checks(), np.zeros((64, 64), bool)
    source[2:6, 2:6] = True
    assert np.isfinite(complete(picture, hole=square_hole(), source=source)).all()
    with pytest.raises(InputError, match="source"):
        complete(picture, hole=square_hole(), source=np.zeros_like(source))
    with pytest.raises(InputError, match="finite"):
        complete(np.full((20, 20, 1), np.nan), hole=np.zeros((20, 20), bool) | (np.arange(20) > 15))
    with pytest.raises(InputError, match="shape|fit"):
        complete(picture, hole=np.ones((3, 3), bool))


@settings(max_examples=25, deadline=None)
@given(
    height=st.integers(3, 30), width=st.integers(3, 30), seed=st.integers(0, 2**32), patch=st.sampled_from([3, 5, 7, 9])
)
def test_any_small_picture_is_filled_or_refused(height, width, seed, patch):
    rng = np.random.default_rng(seed)
    picture = rng.random((height, width, 2)).astype(np.float32)
    hole = rng.random((height, width)) < 0.2
    try:
        filled = complete(picture, hole=hole, seed=seed, params=CompleteParams(patch=patch))
    except InputError as error:
        assert "source" in str(error)
    else:
        assert np.isfinite(filled).all()
        assert (filled[~hole] == picture[~hole]).all()


def test_the_number_of_threads_does_not_matter_but_the_seed_does():
    code = (
        "import numpy as np, hashlib; from tress.image.complete import complete;"
        "p = np.random.default_rng(1).random((70, 70, 3)).astype(np.float32); h = np.zeros((70, 70), bool);"
        "h[20:50, 20:50] = True;"
        "print([hashlib.sha256(complete(p, hole=h, seed=s).tobytes()).hexdigest() for s in (4, 5)])"
    )
    runs = [
        subprocess.run(
            [sys.executable, "-c", code], env={**os.environ, "RAYON_NUM_THREADS": n}, capture_output=True, check=True
        ).stdout
        for n in ("1", "3")
    ]
    assert runs[0] == runs[1]
    first, second = eval(runs[0])
    assert first != second
