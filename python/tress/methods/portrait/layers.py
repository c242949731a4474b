"""The stage `layers`: hair, face, body and background of the photograph."""

import numpy as np
from numpy.typing import NDArray

from tress.base.report import Report
from tress.head.landmarks import FaceLandmarks
from tress.image.layers import LayerParams, Layers, segment_layers
from tress.methods.portrait.priors import face_frame, location_prior

LEAST_HAIR = 0.02
"""Hair of less than this part of the face's area (height squared) counts as none."""


def layers_stage(
    image: NDArray[np.uint8],
    *,
    landmarks: FaceLandmarks,
    person: NDArray[np.float32],
    strokes: NDArray[np.uint8] | None = None,
    params: LayerParams = LayerParams(),
    report: Report,
) -> Layers:
    """Layers of the photograph `image` (H, W, 3) uint8 sRGB, automatic but for what `strokes` (H, W) settle.

    `person` (H, W) float32 in [0, 1] is the person mask. Reports the share of the picture that is hair, and
    `hair_in_faces`, its area in face heights squared; warns where that is less than `LEAST_HAIR`.
    """
    prior = location_prior(landmarks, person=person)
    report.progress(0.1)
    layers = segment_layers(image, prior=prior, strokes=strokes, params=params)
    area = float(layers.hair_mask.sum())
    in_faces = area / face_frame(landmarks).height_px ** 2
    report.number("hair_share", area / layers.label.size)
    report.number("hair_in_faces", in_faces)
    if in_faces < LEAST_HAIR:
        report.warn("next to no hair was found; a stroke on the hair would help if there is some.")
    return layers


def has_hair(layers: Layers, *, landmarks: FaceLandmarks) -> bool:
    """Whether there is hair enough to reconstruct."""
    return float(layers.hair_mask.sum()) >= LEAST_HAIR * face_frame(landmarks).height_px ** 2
