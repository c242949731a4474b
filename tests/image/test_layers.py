"""Layers of made pictures: the cut follows colour, the prior decides where colours agree, strokes mend."""

import cv2
import numpy as np
import pytest

from tress.base.errors import InputError
from tress.image.appearance import learnt_appearance, log_likelihood
from tress.image.labels import BACKGROUND, BODY, FACE, HAIR
from tress.image.layers import LayerParams, segment_layers
from tress.image.reach import reach
from tress.image.spread import spread_of_strokes
from tress.image.strokes import NO_STROKE

SIDE = 160
PARAMS = LayerParams(work_size=SIDE, superpixels=600)
BACKDROP, SHIRT, SKIN, BROWN = (200, 210, 220), (40, 60, 160), (225, 175, 150), (70, 45, 30)


def portrait(*, shirt: tuple[int, int, int] = SHIRT, seed: int = 5) -> tuple[np.ndarray, np.ndarray]:
    """A cartoon head (H, W, 3) with noise, and its true labels: hair above and beside the face, a shirt below."""
    rows, columns = np.indices((SIDE, SIDE)) / SIDE
    truth = np.full((SIDE, SIDE), BACKGROUND, np.uint8)
    truth[(rows > 0.78) & (np.abs(columns - 0.5) < 0.38)] = BODY
    truth[((columns - 0.5) / 0.26) ** 2 + ((rows - 0.42) / 0.33) ** 2 < 1] = HAIR
    truth[((columns - 0.5) / 0.17) ** 2 + ((rows - 0.5) / 0.24) ** 2 < 1] = FACE
    truth[(rows > 0.7) & (rows < 0.8) & (np.abs(columns - 0.5) < 0.1)] = FACE
    colors = np.array([BACKDROP, shirt, SKIN, BROWN], float)[truth]
    noise = np.random.default_rng(seed).normal(0, 6, colors.shape)
    return np.clip(colors + noise, 0, 255).astype(np.uint8), truth


def vague_prior() -> np.ndarray:
    """Knows the middle of every layer and little between."""
    rows, columns = np.indices((SIDE, SIDE)) / SIDE
    away = np.hypot((columns - 0.5) / 0.3, (rows - 0.42) / 0.38)
    prior = np.full((SIDE, SIDE, 4), 0.15, np.float32)
    prior[..., BACKGROUND] += 3 * (away > 1.2) * (rows < 0.75)
    prior[..., FACE] += 2 * np.exp(-(((columns - 0.5) / 0.12) ** 2) - ((rows - 0.52) / 0.17) ** 2)
    prior[..., HAIR] += 2 * np.exp(-(((columns - 0.5) / 0.15) ** 2) - ((rows - 0.16) / 0.08) ** 2)
    prior[..., BODY] += 3 * (rows > 0.85) * (np.abs(columns - 0.5) < 0.3)
    return prior


def agreement(label: np.ndarray, truth: np.ndarray, layer: int) -> float:
    return ((label == layer) & (truth == layer)).sum() / ((label == layer) | (truth == layer)).sum()


def test_a_cartoon_head_comes_apart() -> None:
    image, truth = portrait()
    layers = segment_layers(image, prior=vague_prior(), params=PARAMS)
    for layer in (BACKGROUND, BODY, FACE, HAIR):
        assert agreement(layers.label, truth, layer) > 0.85, layer
    assert layers.probability.sum(axis=-1) == pytest.approx(1, abs=1e-5)
    assert layers.probability.dtype == np.float32 and layers.superpixels.shape == image.shape[:2]
    assert np.array_equal(layers.label, layers.probability.argmax(axis=-1))


def test_a_shirt_of_the_hair_s_colour_stays_a_shirt() -> None:
    image, truth = portrait(shirt=BROWN)
    layers = segment_layers(image, prior=vague_prior(), params=PARAMS)
    below = np.indices(truth.shape)[0] > 0.85 * SIDE
    assert (layers.hair_mask & below).sum() < 0.12 * (truth == BODY).sum()


def test_strokes_mend_a_wrong_cut() -> None:
    image, truth = portrait()
    lock = np.zeros_like(truth, bool)
    lock[60:125, 118:134] = True
    image[lock] = np.clip(
        np.random.default_rng(1).normal(BACKDROP, 6, (lock.sum(), 3)) - 25, 0, 255
    )  # grey hair before a grey backdrop
    truth[lock] = HAIR
    before = segment_layers(image, prior=vague_prior(), params=PARAMS)
    strokes = np.full(truth.shape, NO_STROKE, np.uint8)
    strokes[64:121, 124:128] = HAIR
    after = segment_layers(image, prior=vague_prior(), strokes=strokes, params=PARAMS)
    assert (before.label[lock] == HAIR).mean() < 0.3, "without a stroke the lock is lost"
    assert (after.label[lock] == HAIR).mean() > 0.85, "the stroke brings back all of it, not only itself"
    assert agreement(after.label, truth, HAIR) > 0.8, "and nothing else turns into hair"


def test_every_stroked_pixel_is_what_the_stroke_says() -> None:
    image, _ = portrait()
    strokes = np.full(image.shape[:2], NO_STROKE, np.uint8)
    strokes[80, 40:120] = BODY
    strokes[10:14, 10:14] = HAIR
    label = segment_layers(image, prior=vague_prior(), strokes=strokes, params=PARAMS).label
    drawn = strokes != NO_STROKE
    assert np.array_equal(label[drawn], strokes[drawn])


def test_the_same_input_gives_the_same_bits() -> None:
    image, _ = portrait()
    one, two = (segment_layers(image, prior=vague_prior(), params=PARAMS) for _ in range(2))
    assert np.array_equal(one.probability, two.probability)


def test_a_mirrored_photograph_has_mirrored_layers() -> None:
    image, truth = portrait()
    straight = segment_layers(image, prior=vague_prior(), params=PARAMS).label
    turned = segment_layers(
        np.ascontiguousarray(image[:, ::-1]), prior=np.ascontiguousarray(vague_prior()[:, ::-1]), params=PARAMS
    ).label[:, ::-1]
    assert (straight == turned).mean() > 0.97


def test_a_picture_of_one_colour_follows_the_prior() -> None:
    prior = np.full((64, 64, 4), 0.01, np.float32)
    prior[:32, :, BACKGROUND] = 1
    prior[32:, :, FACE] = 1
    layers = segment_layers(np.full((64, 64, 3), 128, np.uint8), prior=prior, params=LayerParams(superpixels=64))
    assert (layers.label[:24] == BACKGROUND).all() and (layers.label[40:] == FACE).all()


def test_hair_that_looks_like_the_face_is_a_bald_head_unless_a_stroke_says_otherwise() -> None:
    prior = np.full((64, 64, 4), 0.01, np.float32)
    prior[:32, :, HAIR] = 1
    prior[32:, :, FACE] = 1
    image, params = np.full((64, 64, 3), SKIN, np.uint8), LayerParams(superpixels=64)
    assert not segment_layers(image, prior=prior, params=params).hair_mask.any()
    strokes = np.full((64, 64), NO_STROKE, np.uint8)
    strokes[10, 10:50] = HAIR
    assert segment_layers(image, prior=prior, strokes=strokes, params=params).hair_mask[:24].mean() > 0.9


def test_wrong_shapes_are_refused() -> None:
    image, _ = portrait()
    with pytest.raises(InputError, match="prior"):
        segment_layers(image, prior=np.ones((4, 4, 4), np.float32))
    with pytest.raises(InputError, match="image"):
        segment_layers(image[..., 0], prior=vague_prior())
    with pytest.raises(InputError, match="strokes"):
        segment_layers(image, prior=vague_prior(), strokes=np.zeros((3, 3), np.uint8))
    with pytest.raises(InputError, match="value 7"):
        segment_layers(image, prior=vague_prior(), strokes=np.full(image.shape[:2], 7, np.uint8))


def test_a_short_stroke_carries_over_what_looks_like_it() -> None:
    """A hat in the hair's place: one line across it takes all of it off, and nothing of the hair below."""
    image, truth = portrait()
    hat = (truth == HAIR) & (np.indices(truth.shape)[0] < 0.26 * SIDE)
    image[hat] = np.clip(np.random.default_rng(2).normal((150, 40, 90), 6, (hat.sum(), 3)), 0, 255)
    strokes = np.full(truth.shape, NO_STROKE, np.uint8)
    strokes[30:34, 64:96] = BODY
    before = segment_layers(image, prior=vague_prior(), params=PARAMS)
    after = segment_layers(image, prior=vague_prior(), strokes=strokes, params=PARAMS)
    below = (truth == HAIR) & (np.indices(truth.shape)[0] > 0.3 * SIDE)
    assert (before.label[hat] == HAIR).mean() > 0.6
    assert (after.label[hat] == HAIR).mean() < 0.1
    assert (after.label[below] == HAIR).mean() >= (before.label[below] == HAIR).mean() - 0.1


def test_what_a_stroke_says_stops_at_an_edge_and_at_other_strokes() -> None:
    samples = np.zeros((7, 5))
    samples[3] = 60
    edges = np.array([[k, k + 1] for k in range(6)], np.int32)
    strokes = np.full(7, NO_STROKE, np.uint8)
    strokes[0] = BODY
    spread = spread_of_strokes(samples, strokes=strokes, edges=edges)
    assert spread[0, BODY] == 1 and spread[2, BODY] > 0.8 and (spread[3:, BODY] < 0.01).all()
    assert (spread[:, [BACKGROUND, FACE, HAIR]] == 0).all()
    strokes[1] = HAIR
    spread = spread_of_strokes(samples, strokes=strokes, edges=edges)
    assert spread[2, BODY] == 0 and spread[2, HAIR] > 0.8 and spread[1].tolist() == [0, 0, 0, 1]


def test_an_enlarged_photograph_has_the_same_layers() -> None:
    image, _ = portrait()
    prior = vague_prior()
    large = cv2.resize(image, None, fx=4, fy=4, interpolation=cv2.INTER_CUBIC)
    large_prior = cv2.resize(prior, None, fx=4, fy=4, interpolation=cv2.INTER_LINEAR)
    params = LayerParams(work_size=320, superpixels=1000)
    small = segment_layers(image, prior=prior, params=params).hair_mask
    again = segment_layers(large, prior=large_prior, params=params).hair_mask[2::4, 2::4]
    assert (small & again).sum() / (small | again).sum() > 0.95


def test_a_step_of_colour_is_a_toll_on_the_way() -> None:
    """A ring of four nodes: the shortest way goes round the dear edge."""
    edges, start = np.array([[0, 1], [1, 2], [2, 3], [0, 3]]), np.array([True, False, False, False])
    tolls = np.array([0.0, 1.0, 1.0, 1.0])
    assert reach(tolls, edges=edges, start=start) == pytest.approx([0, 1, 2, 1], abs=1e-6)
    dear = reach(tolls, edges=edges, start=start, step=np.array([0.0, 0.0, 0.0, 5.0]))
    assert dear == pytest.approx([0, 1, 2, 3], abs=1e-6)


def test_skin_is_learnt_past_a_fringe() -> None:
    """A quarter of the face's patches are dark strands; they are still unlike skin."""
    random = np.random.default_rng(2)
    skin = random.normal([70, 15, 15, 0, 5], [5, 2, 2, 3, 3], (300, 5))
    strands = random.normal([28, 3, 5, 10, 11], [5, 2, 2, 3, 3], (100, 5))
    samples = np.concatenate([skin, strands])
    weights = np.zeros((400, 4))
    weights[:, FACE] = 1
    learnt = learnt_appearance(samples, weights=weights, strokes=np.full(400, NO_STROKE, np.uint8))
    look = log_likelihood(learnt, samples)[:, FACE]
    assert np.median(look[:300]) - np.median(look[300:]) > 4
