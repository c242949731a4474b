"""Spikes in tiers, up at the crown, out at the sides, down at the nape."""

import numpy as np

from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.clump import ClumpShape
from tress.methods.cartoon.face_frame import with_bangs
from tress.methods.cartoon.layer import with_cap, with_clumps
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.sheets import bezier, sheet
from tress.methods.cartoon.skull import skull_of
from tress.methods.cartoon.tuft import Tuft
from tress.methods.cartoon.variation import ClumpVariation
from tress.model.document import Document

SPIKE = ClumpShape(radii=(0.0, 0.7, 1.0, 1.0, 1.0, 1.0), tip_shape=((0, 1), (0.5, 0.62), (1, 0)))
TIERS = (
    ("nape", (70, 290), 86.0, 0.08, (0.35, 0.9, -0.1), 11),
    ("low", (62, 298), 68.0, 0.11, (0.8, 0.6, -0.05), 11),
    ("middle", (40, 320), 46.0, 0.13, (0.8, 0.6, 0.05), 9),
    ("high", (0, 324), 26.0, 0.13, (0.75, 0.6, 0.2), 7),
    ("top", (0, 270), 8.0, 0.11, (0.9, 0.3, 0.3), 4),
)
"""Group, azimuths and polar angle (degrees) where spikes leave the head, length (m), way of the tips (off the head,
along it, upwards), clumps."""
BACK = np.array([0, 0, -0.25])


def spiky(document: Document, params: CartoonParams) -> Document:
    """Spikes all round, tiers of chunky clumps out of the whorl that stand off the head."""
    skull = skull_of(document)
    document = with_cap(document, skull)
    for index, (name, (first, last), polar, length_m, (off, along, up), hairs) in enumerate(TIERS):
        around = np.radians(np.linspace(first, last, 24))
        on_head = [skull.points(around, np.radians(share * polar) * np.ones(24)) for share in (0.08, 0.5, 1.0, 1.1)]
        root, middle, edge, after = on_head
        tip = off * _unit(edge) + along * _unit(after - edge) + up * np.array([0, 1, 0]) + BACK
        tip = length_m * params.length * _unit(tip)
        curves = bezier(np.stack([root, 1.16 * middle, 1.18 * edge, 1.1 * edge + tip], axis=1))
        tuft = Tuft(
            hairs=KeyHairParams(hairs=params.count(hairs), points=14, jitter=0.5, seed=params.seed + index),
            clump=ClumpParams(vertical_radius=0.014, horizontal_radius=0.034 * params.widening, pointiness=0.7),
            shape=SPIKE,
            variation=ClumpVariation(
                radius_low=0.85,
                radius_high=1.2,
                length_low=0.7,
                twist_low=-0.5,
                twist_high=0.5,
                seed=params.seed + index,
            ),
        )
        document = with_clumps(document, name=name, surface=sheet(curves), tuft=tuft)
    return with_bangs(document, skull, params, hairs=6, end=0.1, width_m=0.024, spread=58, sideways=-0.015)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
