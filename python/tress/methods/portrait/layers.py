"""The stage `layers`: hair, face, body and background of the photograph."""

import numpy as np
from numpy.typing import NDArray

from tress.base.report import Report
from tress.head.landmarks import FaceLandmarks
from tress.image.labels import FACE, HAIR, LAYER_COUNT
from tress.image.layers import LayerParams, Layers, segment_layers
from tress.image.strokes import NO_STROKE
from tress.methods.portrait.priors import FaceFrame, face_frame, location_prior

LEAST_HAIR = 0.02
"""Hair of less than this part of the face's area (height squared) counts as none."""
_AROUND, _BELOW = 2.5, 3.5
"""Face heights around the eyes, and below them, that hair may reach."""


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
    `hair_in_faces`, its area in face heights squared; warns where a hat or scarf is likely among it.
    """
    frame = face_frame(landmarks)
    prior = location_prior(landmarks, person=person)
    report.progress(0.1)
    box = _box_of_hair(frame, image.shape[:2])
    layers = segment_layers(
        np.ascontiguousarray(image[box]),
        prior=prior[box],
        strokes=None if strokes is None else np.ascontiguousarray(strokes[box]),
        params=params,
    )
    layers = _within(layers, prior, box, strokes)
    area = float(layers.hair_mask.sum())
    in_faces = area / frame.height_px**2
    report.number("hair_share", area / layers.label.size)
    report.number("hair_in_faces", in_faces)
    if layers.covering >= 1:
        report.warn(
            "what covers the head differs from the hair below it, as a hat or a scarf does; if it is one, mark it as "
            "body with --strokes, and look at stages/layers."
        )
    return layers


def has_hair(layers: Layers, *, landmarks: FaceLandmarks) -> bool:
    """Whether there is hair enough to reconstruct."""
    return float(layers.hair_mask.sum()) >= LEAST_HAIR * face_frame(landmarks).height_px ** 2


def _box_of_hair(frame: FaceFrame, shape: tuple[int, ...]) -> tuple[slice, slice]:
    """Rows and columns that hold any hair of the head, so that a small head in a large picture gets patches enough."""
    x, y = frame.eyes
    around, below = _AROUND * frame.height_px, _BELOW * frame.height_px
    rows = slice(max(0, int(y - around)), min(shape[0], int(y + below) + 1))
    return rows, slice(max(0, int(x - around)), min(shape[1], int(x + around) + 1))


def _within(
    inner: Layers, prior: NDArray[np.float32], box: tuple[slice, slice], strokes: NDArray[np.uint8] | None
) -> Layers:
    """`inner` put back into the picture; outside the box is background or body, as the prior or a stroke has it."""
    if inner.label.shape == prior.shape[:2]:
        return inner
    probability = prior.copy()
    probability[..., [FACE, HAIR]] = 0
    if strokes is not None:
        drawn = strokes != NO_STROKE
        probability[drawn] = np.eye(LAYER_COUNT, dtype=np.float32)[strokes[drawn]]
    probability /= np.maximum(probability.sum(axis=-1, keepdims=True), 1e-6)
    probability[box] = inner.probability
    patches = np.full(prior.shape[:2], int(inner.superpixels.max()) + 1, np.int32)
    patches[box] = inner.superpixels
    return Layers(probability.argmax(axis=-1).astype(np.uint8), probability, patches, inner.covering)
