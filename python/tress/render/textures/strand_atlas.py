"""Strands for strips: cards of hair from parameters, baked side by side into one atlas."""

from typing import Any

import numpy as np

from tress.base.color import linear_to_srgb8
from tress.base.report import Report
from tress.model.atlas import Atlas
from tress.render.textures.ambient_occlusion import ambient_occlusion
from tress.render.textures.bake import BakedCard, bake_card
from tress.render.textures.card_kinds import KINDS
from tress.render.textures.card_strands import card_strands
from tress.render.textures.dilate import dilated
from tress.render.textures.encode import direction_bytes, share_bytes
from tress.render.textures.layout import Layout, card_layout
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_colors import strand_colors

Array = np.ndarray[Any, Any]

_CHANNELS = {
    "color": 4,
    "normal": 3,
    "flow": 3,
    "root_to_tip": 1,
    "depth": 1,
    "ambient_occlusion": 1,
    "strand_id": 1,
}


def strand_atlas(params: TextureParams, *, report: Report) -> Atlas:
    """An atlas with one region for every variation, and maps, all uint8: normal, flow, root_to_tip, depth, strand_id ….

    Straight alpha; under zero alpha every map continues what is nearest within the card's cell. The same parameters
    give the same bits on any number of cores. Raises `ParameterError` where the cards do not fit the resolution. Cost:
    about one second a million pixels of one core.

    >>> atlas = strand_atlas(TextureParams(resolution=64, variations=2, padding=2), report=Report())
    >>> atlas.color.shape, len(atlas.regions), sorted(atlas.maps)[:3]
    ((128, 64, 4), 2, ['ambient_occlusion', 'depth', 'flow'])
    """
    layout = card_layout(params.variations, width=params.resolution, aspect=params.aspect, padding=params.padding)
    pictures = {
        name: np.zeros((layout.height, layout.width, channels), np.uint8) for name, channels in _CHANNELS.items()
    }
    for variation in range(params.variations):
        for name, values in _cell_maps(params, layout, variation).items():
            pictures[name][layout.cell(variation)] = values.reshape(*values.shape[:2], -1)
        report.progress((variation + 1) / params.variations)
    color = pictures.pop("color")
    maps = {name: values[..., 0] if values.shape[2] == 1 else values for name, values in pictures.items()}
    return Atlas(color=color, regions=layout.regions.astype(np.float32), maps=maps)


def _cell_maps(params: TextureParams, layout: Layout, variation: int) -> dict[str, Array]:
    """The pictures (H, W, ...) uint8 of one card with its border."""
    random = np.random.default_rng([params.seed, variation])
    kind = KINDS[params.kind_of(variation)]
    strands = card_strands(params, kind=kind, aspect=layout.aspect, random=random)
    colors = strand_colors(strands, params=params, random=random)
    card = bake_card(strands, colors, width=layout.card_width, height=layout.card_height)
    maps = {name: _bordered(values, layout.padding) for name, values in _encoded(card, params).items()}
    alpha = maps.pop("alpha")
    maps = dilated(maps, alpha=alpha)
    maps["color"] = np.concatenate([maps["color"], alpha[..., None]], axis=-1)
    return maps


def _encoded(card: BakedCard, params: TextureParams) -> dict[str, Array]:
    """Bytes of every map, `alpha` among them and `color` without it."""
    openness = ambient_occlusion(card.depth, coverage=card.coverage)
    shade = 1 - params.depth_shading * (1 - openness)
    return {
        "alpha": share_bytes(card.coverage),
        "color": linear_to_srgb8(card.color * shade[..., None]),
        "normal": direction_bytes(card.normal),
        "flow": direction_bytes(card.flow),
        "root_to_tip": share_bytes(card.root_to_tip),
        "depth": share_bytes(card.depth),
        "ambient_occlusion": share_bytes(openness),
        "strand_id": card.strand_id,
    }


def _bordered(values: Array, padding: int) -> Array:
    return np.pad(values, ((padding, padding), (padding, padding), *((0, 0),) * (values.ndim - 2)))
