"""The four layers of a portrait: hair, face, body, background.

In the manner of Lazy Snapping (Li et al. 2004), as Chai et al. 2012 use it, but without a user: a location prior takes
the place of the strokes. Superpixels get a cost for every layer, from the prior and from mixtures of colour and fine
texture that are learnt from this photograph alone; a graph cut parts them; the mixtures are learnt again from the
cut, a few times over. Strokes, where there are any, are hard constraints and also teach the mixtures.

The cut is made in three exact two-label steps (hair from the rest, background from the rest, face from body), which is
as good here as expanding over four labels and takes a third of the time.

Limits: what looks like hair, lies where hair may lie and touches hair becomes hair (a fur collar, a dark coat behind
dark hair); hair whose colour is that of the skin or of the backdrop is lost. A stroke or two mends these.
"""

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

from tress.base.errors import InputError
from tress.base.params import Params, param
from tress.image.appearance import features, learnt_appearance, log_likelihood
from tress.image.color import require_photograph
from tress.image.covering import covering
from tress.image.cut import two_label_cut
from tress.image.guided_filter import guided_filter
from tress.image.labels import BACKGROUND, BODY, FACE, HAIR, LAYER_COUNT
from tress.image.mixture import fitted_mixture, log_density
from tress.image.reach import reach
from tress.image.spread import spread_of_strokes
from tress.image.strand_odds import color_steps, strand_odds
from tress.image.strokes import NO_STROKE
from tress.image.superpixels import Superpixels, mean_over, superpixels

_NEVER = 1e5
_LEAST_PRIOR = 1e-4
_ALIKE = 1.0
"""Logarithm of likelihood by which hair may explain its own seeds better than the face does and still be like it."""
_BARE = (0.42, 0.58)
"""Share of hair's seeds that look like the face: up to the first it is hair, from the second on the head is bald."""

_ROOTED = 0.52
"""Prior of hair from which on hair may have its roots there: not below the chin."""
_TO_SKIN = 2.0
"""Logarithm of likelihood by which skin explains a patch better at which its strands say nothing; one less, and all."""
_STEP_OF_HAIR = 14.0
"""Step in Lab between neighbours that hair takes for nothing; each more costs a toll of 1 below the chin."""
_NEAR = 0.06
"""Distance from the person, as part of the picture's longer side, at which the backdrop teaches 1/e as much."""


@dataclass(frozen=True)
class LayerParams(Params):
    """Settings of `segment_layers`."""

    work_size: int = param(640, low=64, high=4096, unit="px", doc="Longer side at which the layers are cut.")
    superpixels: int = param(4000, low=16, high=50_000, doc="Number of superpixels.")
    compactness: float = param(8.0, low=0.1, high=100.0, doc="Roundness of the superpixels.")
    rounds: int = param(4, low=1, high=20, doc="Times that appearance is learnt and the layers are cut.")
    prior_weight: float = param(1.0, low=0.0, high=10.0, doc="Weight of the location prior's logarithm.")
    look_weight: float = param(0.8, low=0.0, high=10.0, doc="Weight of colour and texture, as logarithm of likelihood.")
    most_look: float = param(
        4.0, low=0.1, high=100.0, doc="Most that colour and texture can say for or against a layer."
    )
    smoothness: float = param(2.5, low=0.0, high=100.0, doc="Cost of a border between like superpixels.")
    contrast: float = param(8.0, low=0.1, high=100.0, unit="Lab", doc="Difference at which a border costs 1/e.")
    strand_weight: float = param(0.6, low=0.0, high=10.0, doc="Weight of a patch's strandiness, as logarithm of odds.")
    reach_weight: float = param(0.5, low=0.0, high=10.0, doc="Weight of the way from sure hair to a patch.")
    reach_bonus: float = param(1.5, low=0.0, high=10.0, doc="What being within reach says for hair.")
    most_reach: float = param(6.0, low=0.0, high=100.0, doc="Most that being out of reach says against hair.")
    stroke_weight: float = param(5.0, low=0.0, high=20.0, doc="Weight of a stroke where it carries to, as log of odds.")
    edge_radius: int = param(5, low=1, high=64, unit="px", doc="Reach of the last fitting to the photograph's edges.")


@dataclass(frozen=True)
class Layers:
    """What belongs to which layer: `label` (H, W) uint8 (0 background, 1 body, 2 face, 3 hair), `probability` (H, W, 4)
    float32 adding up to 1, `superpixels` (H, W) int32, the patches that were cut, `covering` >= 0, the evidence that
    some of the hair is a hat or a scarf; from 1 on it is likely."""

    label: NDArray[np.uint8]
    probability: NDArray[np.float32]
    superpixels: NDArray[np.int32]
    covering: float = 0.0

    @property
    def hair_mask(self) -> NDArray[np.bool_]:
        """(H, W) bool: where the label is hair."""
        return self.label == HAIR


def segment_layers(
    image: NDArray[np.uint8],
    *,
    prior: NDArray[np.float32],
    strokes: NDArray[np.uint8] | None = None,
    params: LayerParams = LayerParams(),
) -> Layers:
    """Layers of the photograph `image` (H, W, 3) uint8 sRGB.

    `prior` (H, W, 4) float32 > 0: how likely every layer is at a place, before looking at colours; it need not
    add up to 1. `strokes` (H, W) uint8: a label, or 255 where the user said nothing; every stroked pixel comes out as
    the stroke says. Deterministic. Cost: about 0.6 s for 1000 x 1000 pixels on two cores.

    Raises `InputError` where shapes or types do not fit.
    """
    require_photograph(image)
    strokes = _checked_strokes(strokes, image)
    if prior.shape != (*image.shape[:2], LAYER_COUNT):
        raise InputError(f"the prior is {prior.shape}; {(*image.shape[:2], LAYER_COUNT)} was expected.")
    small = _at_work_size(image, params.work_size)
    patches = superpixels(small, count=params.superpixels, compactness=params.compactness)  # type: ignore[arg-type]
    patch_prior = _patch_prior(prior, patches)
    patch_stroke = _patch_strokes(strokes, patches)
    label, soft = _cut_layers(patches, patch_prior, patch_stroke, params)
    layers = _at_full_size(image, small, patches, label, soft, strokes, params)  # type: ignore[arg-type]
    covered = covering(patches, hair=label == HAIR, rooted=patch_prior[:, HAIR] > _ROOTED, strands=strand_odds(patches))
    return replace(layers, covering=covered)


def _at_work_size(image: NDArray[np.uint8], longer_side: int) -> NDArray[np.uint8]:
    """The photograph, smaller or larger, with one size of patches and textures whatever its own."""
    scale = longer_side / max(image.shape[:2])
    size = (max(1, round(image.shape[1] * scale)), max(1, round(image.shape[0] * scale)))
    sized = cv2.resize(image, size, interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC)
    return np.asarray(sized, np.uint8)


def _checked_strokes(strokes: NDArray[np.uint8] | None, image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    if strokes is None:
        return np.full(image.shape[:2], NO_STROKE, np.uint8)
    if strokes.shape != image.shape[:2] or strokes.dtype != np.uint8:
        raise InputError(f"the strokes are {strokes.dtype} {strokes.shape}; uint8 {image.shape[:2]} was expected.")
    unknown = np.setdiff1d(strokes, [*range(LAYER_COUNT), NO_STROKE])
    if len(unknown):
        raise InputError(f"the strokes hold the value {unknown[0]}; labels 0 to 3, or 255 for none, were expected.")
    return strokes


def _patch_prior(prior: NDArray[np.float32], patches: Superpixels) -> NDArray[np.float64]:
    height, width = patches.label.shape
    small = np.asarray(cv2.resize(prior, (width, height), interpolation=cv2.INTER_AREA), np.float32)
    mean = np.maximum(mean_over(patches.label, small, patches.area).astype(np.float64), _LEAST_PRIOR)
    return mean / mean.sum(axis=1, keepdims=True)


def _patch_strokes(strokes: NDArray[np.uint8], patches: Superpixels) -> NDArray[np.uint8]:
    """(N,) the label that most stroked pixels of the patch have, or 255."""
    height, width = patches.label.shape
    rows, columns = np.nonzero(strokes != NO_STROKE)
    patch = patches.label[rows * height // strokes.shape[0], columns * width // strokes.shape[1]]
    votes = np.zeros((patches.count, LAYER_COUNT), np.int64)
    np.add.at(votes, (patch, strokes[rows, columns]), 1)
    return np.where(votes.any(axis=1), votes.argmax(axis=1), NO_STROKE).astype(np.uint8)


def _cut_layers(
    patches: Superpixels, prior: NDArray[np.float64], stroke: NDArray[np.uint8], params: LayerParams
) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    samples = features(patches)
    border = _border_cost(patches, params)
    prior = _with_spread_strokes(samples, prior, stroke, patches, params.stroke_weight)
    seeds = _Seeds.of(samples, prior, stroke, patches)
    if (left := _hair_left(seeds, stroke)) < 1:
        prior = prior * np.where(np.arange(LAYER_COUNT) == HAIR, left, 1.0)
        prior /= prior.sum(axis=1, keepdims=True)
        seeds = _Seeds.of(samples, prior, stroke, patches)
    weights = _first_weights(samples, seeds, stroke, patches)
    label = prior.argmax(axis=1).astype(np.uint8)
    roots = weights[:, HAIR].copy()
    cost = -np.log(prior)
    for number in range(params.rounds):
        look = log_likelihood(learnt_appearance(samples, weights=weights, strokes=stroke), samples)
        cost = _costs(look, prior, stroke, params)
        cost = _with_reach(cost, roots, stroke, patches, prior, look, params)
        label = _cut_incolor_steps(cost, patches.edges, border, final=number == params.rounds - 1)
        weights = _weights_of_cut(label, prior, stroke, patches)
        weights[:, BODY] *= np.maximum(1 - _likeness(samples, look[:, HAIR]), 0.02)
    return label, cost


def _with_spread_strokes(
    samples: NDArray[np.float64],
    prior: NDArray[np.float64],
    stroke: NDArray[np.uint8],
    patches: Superpixels,
    weight: float,
) -> NDArray[np.float64]:
    """The prior, with what was stroked likelier where strokes carry to."""
    if (stroke == NO_STROKE).all():
        return prior
    prior = prior * np.exp(weight * spread_of_strokes(samples, strokes=stroke, edges=patches.edges))
    prior = np.maximum(prior / prior.sum(axis=1, keepdims=True), _LEAST_PRIOR)
    return prior / prior.sum(axis=1, keepdims=True)


def _sure_places(prior: NDArray[np.float64], stroke: NDArray[np.uint8], patches: Superpixels) -> NDArray[np.float64]:
    return _with_strokes(_lesson(prior, patches)[:, None] * np.maximum(prior - 0.4, 0) ** 2, stroke, patches)


def _lesson(prior: NDArray[np.float64], patches: Superpixels) -> NDArray[np.float64]:
    """How much each patch (N,) has to teach: its area, and less where the backdrop is far from the person."""
    person = (prior[:, BACKGROUND] < 0.5)[patches.label]
    away = cv2.distanceTransform((~person).astype(np.uint8), cv2.DIST_L2, 5)
    distance = mean_over(patches.label, np.asarray(away, np.float32), patches.area) / max(patches.label.shape)
    return patches.area * (0.05 + 0.95 * np.exp(-distance / _NEAR)) if person.any() else patches.area.astype(np.float64)


@dataclass(frozen=True)
class _Seeds:
    """`weight` (N, 4) of the patches where the prior is surest of each layer; what these are like, as a `look` (N, 4)
    of all patches."""

    weight: NDArray[np.float64]
    look: NDArray[np.float64]

    @classmethod
    def of(
        cls, samples: NDArray[np.float64], prior: NDArray[np.float64], stroke: NDArray[np.uint8], patches: Superpixels
    ) -> "_Seeds":
        weight = _sure_places(prior, stroke, patches)
        return cls(weight, log_likelihood(learnt_appearance(samples, weights=weight, strokes=stroke), samples))


def _hair_left(seeds: _Seeds, stroke: NDArray[np.uint8]) -> float:
    """1; next to nothing where the places of surest hair look like the face: a bald head."""
    if (stroke == HAIR).any() or seeds.weight[:, HAIR].sum() <= 0:
        return 1.0
    like_face = _share(seeds.look + _ALIKE * np.eye(LAYER_COUNT)[FACE], FACE, (HAIR,))
    bare = float(np.average(like_face, weights=seeds.weight[:, HAIR]))
    return float(np.interp(bare, _BARE, (1.0, _LEAST_PRIOR)))


def _first_weights(
    samples: NDArray[np.float64], sure: _Seeds, stroke: NDArray[np.uint8], patches: Superpixels
) -> NDArray[np.float64]:
    """The seeds of the layers, less what looks like another layer's surer seeds."""
    seeds = sure.weight.copy()
    seeds[:, HAIR] *= _share(sure.look, HAIR, (FACE, BACKGROUND))
    look = log_likelihood(learnt_appearance(samples, weights=seeds, strokes=stroke), samples)
    seeds[:, BODY] *= _share(look, BODY, (FACE, BACKGROUND)) * np.maximum(1 - _likeness(samples, look[:, HAIR]), 0.02)
    return _with_strokes(seeds, stroke, patches)


def _share(look: NDArray[np.float64], layer: int, others: tuple[int, ...]) -> NDArray[np.float64]:
    ahead = look[:, layer] - look[:, list(others)].max(axis=1)
    return 1 / (1 + np.exp(-np.clip(ahead, -30, 30)))


def _likeness(samples: NDArray[np.float64], look: NDArray[np.float64]) -> NDArray[np.float64]:
    """How much better (0 to 1) a layer explains every sample than the photograph as a whole does."""
    whole = fitted_mixture(
        samples, weights=np.ones(len(samples)), count=1, floor=np.ones(samples.shape[1]), iterations=0
    )
    return 1 / (1 + np.exp(-np.clip(look - log_density(whole, samples) - 1.0, -30, 30)))


def _with_reach(
    cost: NDArray[np.float64],
    seeds: NDArray[np.float64],
    stroke: NDArray[np.uint8],
    patches: Superpixels,
    prior: NDArray[np.float64],
    look: NDArray[np.float64],
    params: LayerParams,
) -> NDArray[np.float64]:
    """Costs (N, 4) in which hair is dearer the harder it is to get there from the hair's seeds, walking over what is
    likely hair in small steps of colour, and clothes are dearer where it is easy: long hair goes on downwards.
    Strands speak for hair, but not where the colour is the skin's: an ear has edges too."""
    strand = params.strand_weight * strand_odds(patches) * (cost[:, HAIR] < _NEVER)
    strand = np.where(strand > 0, strand * np.clip(_TO_SKIN - (look[:, FACE] - look[:, HAIR]), 0, 1), strand)
    behind = cost[:, HAIR] - strand - cost[:, [BACKGROUND, BODY, FACE]].min(axis=1)
    toll = np.maximum(behind, 0)
    start = _largest_patchwork((seeds > 0.3 * seeds.max()) & (behind < 0) & (prior[:, HAIR] > _ROOTED), patches)
    edges = np.concatenate([patches.edges, _over_the_top(patches, (behind < 0) & (prior[:, HAIR] > 0.4))])
    step = np.maximum(color_steps(patches, edges) / _STEP_OF_HAIR - 1, 0)
    step *= prior[edges, HAIR].min(axis=1) < _ROOTED  # from a hat to the hair below it is no step
    way = np.minimum(reach(toll, edges=edges, start=start | (stroke == HAIR), step=step) - toll, _NEVER)
    cost = cost.copy()
    cost[:, HAIR] += np.minimum(params.reach_weight * way, params.most_reach)
    cost[:, HAIR] = np.maximum(cost[:, HAIR] - strand * np.exp(-way), 0)
    cost[:, BODY] += params.reach_bonus * (way < 1) * (prior[:, HAIR] > 0.1) * (1 - np.minimum(way, 1))
    cost[stroke == HAIR, HAIR] = 0
    return cost


def _over_the_top(patches: Superpixels, hairy: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Pairs (K, 2) of patches at the picture's upper rim that hair joins above it, where the head is cut off."""
    rim = np.unique(patches.label[0])
    rim = rim[hairy[rim]]
    rim = rim[np.argsort(patches.center[rim, 0], kind="stable")]
    return np.stack([rim[:-1], rim[1:]], axis=1).astype(np.int32)


def _largest_patchwork(chosen: NDArray[np.bool_], patches: Superpixels) -> NDArray[np.bool_]:
    """`chosen` (N,) without connected groups of patches of less than a twentieth of the largest group's area."""
    inside = patches.edges[chosen[patches.edges].all(axis=1)]
    graph = csr_matrix((np.ones(len(inside), bool), (inside[:, 0], inside[:, 1])), shape=(patches.count,) * 2)
    group = connected_components(graph, directed=False)[1]
    area = np.bincount(group, weights=np.where(chosen, patches.area, 0.0))
    return chosen & (area[group] >= 0.05 * area.max())


def _with_strokes(weights: NDArray[np.float64], stroke: NDArray[np.uint8], patches: Superpixels) -> NDArray[np.float64]:
    drawn = stroke != NO_STROKE
    weights[drawn] = 0
    weights[drawn, stroke[drawn]] = patches.area[drawn]
    return weights


def _weights_of_cut(
    label: NDArray[np.uint8], prior: NDArray[np.float64], stroke: NDArray[np.uint8], patches: Superpixels
) -> NDArray[np.float64]:
    weights = np.zeros_like(prior)
    node = np.arange(len(label))
    weights[node, label] = _lesson(prior, patches) * prior[node, label]
    return _with_strokes(weights, stroke, patches)


def _border_cost(patches: Superpixels, params: LayerParams) -> NDArray[np.float64]:
    first, second = patches.edges.T
    difference_sq = ((patches.lab[first] - patches.lab[second]) ** 2).sum(axis=1)
    length = patches.border / np.median(patches.border)
    return params.smoothness * length * (0.05 + np.exp(-difference_sq / (2 * params.contrast**2)))


def _costs(
    look: NDArray[np.float64], prior: NDArray[np.float64], stroke: NDArray[np.uint8], params: LayerParams
) -> NDArray[np.float64]:
    behind = np.minimum(look.max(axis=1, keepdims=True) - look, params.most_look / params.look_weight)
    cost = params.look_weight * behind - params.prior_weight * np.log(prior)
    cost -= cost.min(axis=1, keepdims=True)
    drawn = stroke != NO_STROKE
    cost[drawn] = _NEVER
    cost[drawn, stroke[drawn]] = 0
    return cost


def _cut_incolor_steps(
    cost: NDArray[np.float64], edges: NDArray[np.int32], border: NDArray[np.float64], *, final: bool
) -> NDArray[np.uint8]:
    """Hair from the rest; then, for the last round, background from the rest and face from body."""
    rest = cost[:, [BACKGROUND, BODY, FACE]]
    hair = two_label_cut(np.column_stack([rest.min(axis=1), cost[:, HAIR]]), edges=edges, weight=border)
    label = rest.argmin(axis=1).astype(np.uint8)
    if final:
        label = _cut_rest(cost, edges, border, hair)
    label[hair] = HAIR
    return label


def _cut_rest(
    cost: NDArray[np.float64], edges: NDArray[np.int32], border: NDArray[np.float64], hair: NDArray[np.bool_]
) -> NDArray[np.uint8]:
    free = cost.copy()
    free[hair] = 0
    person = free[:, [BODY, FACE]].min(axis=1)
    behind = two_label_cut(np.column_stack([person, free[:, BACKGROUND]]), edges=edges, weight=border)
    face = two_label_cut(free[:, [BODY, FACE]], edges=edges, weight=border)
    return np.where(behind, BACKGROUND, np.where(face, FACE, BODY)).astype(np.uint8)


def _at_full_size(
    image: NDArray[np.uint8],
    small: NDArray[np.uint8],
    patches: Superpixels,
    label: NDArray[np.uint8],
    cost: NDArray[np.float64],
    strokes: NDArray[np.uint8],
    params: LayerParams,
) -> Layers:
    cut = np.eye(LAYER_COUNT, dtype=np.float32)[label]
    share = np.exp(-np.minimum(cost, 50))
    soft = 0.9 * cut + 0.1 * (share / share.sum(axis=1, keepdims=True)).astype(np.float32)
    fitted = guided_filter(soft[patches.label], guide=small, radius=params.edge_radius)
    height, width = image.shape[:2]
    probability = cv2.resize(fitted, (width, height), interpolation=cv2.INTER_LINEAR)
    probability = np.clip(probability, 1e-4, 1)
    drawn = strokes != NO_STROKE
    probability[drawn] = np.eye(LAYER_COUNT, dtype=np.float32)[strokes[drawn]]
    probability /= probability.sum(axis=-1, keepdims=True)
    patch = cv2.resize(patches.label, (width, height), interpolation=cv2.INTER_NEAREST)
    return Layers(probability.argmax(axis=-1).astype(np.uint8), probability, np.asarray(patch, np.int32))
