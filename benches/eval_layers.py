"""Intersection over union of the hair masks with the open data's: hand-labelled photographs and rendered grooms."""

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from benches.metrics import intersection_over_union
from benches.open_data import OPEN_DATA, synthetic_cases
from tress.base.report import Report
from tress.head.person import person_mask
from tress.head.read_face import read_face
from tress.image.layers import LayerParams
from tress.methods.portrait.layers import layers_stage

_HAIR_LABEL = {"ffhq": 1, "helen": 10}
"""Label of hair in the masks of each source."""


def hair_mask_iou_table() -> Table:
    """IoU of every case and their mean, as a table; without rows where the open data is absent."""
    table = Table("case", "hair mask IoU", title="Hair masks (a constant mask scores 0.30 to 0.44)")
    scores = hair_mask_ious()
    for name, value in scores.items():
        table.add_row(name, f"{value:.3f}")
    if scores:
        table.add_row("mean", f"{np.mean(list(scores.values())):.3f}", style="bold")
    return table


def hair_mask_ious(params: LayerParams = LayerParams()) -> dict[str, float]:
    """IoU by the name of the case; empty where the open data is absent."""
    return {name: _hair_iou(photo, truth, params) for name, (photo, truth) in _cases().items()}


def _cases() -> dict[str, tuple[Path, NDArray[np.bool_]]]:
    cases: dict[str, tuple[Path, NDArray[np.bool_]]] = {}
    for label in sorted((OPEN_DATA / "masks").glob("*_label.png")):
        name = label.name.removesuffix("_label.png")
        (photo,) = label.parent.glob(f"{name}_photo.*")
        cases[name] = photo, cv2.imread(str(label), cv2.IMREAD_UNCHANGED) == _HAIR_LABEL[name.split("_")[0]]
    for folder in synthetic_cases():
        with np.load(folder / "truth.npz") as truth:
            cases[folder.name] = folder / "photo.png", truth["hair_mask"] > 127
    return cases


def _hair_iou(photo: Path, truth: NDArray[np.bool_], params: LayerParams) -> float:
    picture = cv2.imread(str(photo), cv2.IMREAD_COLOR)
    assert picture is not None, photo
    image = np.ascontiguousarray(picture[..., ::-1])
    landmarks = read_face(image)
    person = person_mask(image, landmarks=landmarks)
    layers = layers_stage(image, landmarks=landmarks, person=person, params=params, report=Report())
    return intersection_over_union(layers.hair_mask, truth)
