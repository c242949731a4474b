"""Pictures side by side, with drawings of corrections over them."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from PIL import Image

from tress.render.preview import contact_sheet

Array = np.ndarray[Any, Any]
FOLDER = Path(__file__).parents[2] / "docs" / "pictures"

WIDEST_PX = 1200
HEIGHT_PX = 400
LAYER_INK = {"hair": (230, 40, 40), "face": (240, 210, 40), "body": (40, 180, 60), "background": (50, 90, 240)}
INK = (255, 60, 200)


def save(picture: Array, name: str) -> None:
    """Saves a picture for the documentation, at most `WIDEST_PX` wide."""
    scale = min(1.0, WIDEST_PX / picture.shape[1])
    size = (round(picture.shape[1] * scale), round(picture.shape[0] * scale))
    FOLDER.mkdir(exist_ok=True)
    Image.fromarray(picture).resize(size, Image.Resampling.LANCZOS).save(
        FOLDER / f"{name}.jpg", quality=82, optimize=True, progressive=True
    )
    print(f"docs/pictures/{name}.jpg", flush=True)


def side_by_side(pictures: Sequence[Array], captions: Sequence[str]) -> Array:
    """The pictures at one height, each with its caption."""
    return contact_sheet([np.ascontiguousarray(picture) for picture in pictures], captions=captions, height=HEIGHT_PX)


def rows(sheets: Sequence[Array]) -> Array:
    """Sheets one below the other, filled up on the right."""
    width = max(sheet.shape[1] for sheet in sheets)
    return np.concatenate([_widened(sheet, width) for sheet in sheets])


def with_strokes(photo: Array, strokes: Sequence[Mapping[str, Any]]) -> Array:
    """The photo with strokes drawn over it, in the colour of their layer, if they have one."""
    drawn = photo.copy()
    for stroke in strokes:
        points = np.array(stroke["points"], np.int32)[:, None]
        ink = LAYER_INK.get(stroke.get("layer", ""), INK)
        cv2.polylines(drawn, [points], isClosed=False, color=ink, thickness=int(stroke["width"]), lineType=cv2.LINE_AA)
    return drawn


def with_points(photo: Array, points: Mapping[str, Sequence[float]]) -> Array:
    """The photo with named points marked in it; names of the person's right stand on the left."""
    drawn = photo.copy()
    size = max(photo.shape[:2]) / 250
    font, scale = cv2.FONT_HERSHEY_SIMPLEX, size / 9
    for name, (x, y) in points.items():
        place = (round(x), round(y))
        cv2.circle(drawn, place, round(size), INK, -1, cv2.LINE_AA)
        (width, _), _ = cv2.getTextSize(name, font, scale, 1)
        left = place[0] - width - round(2 * size) if name.startswith("right") else place[0] + round(2 * size)
        cv2.putText(drawn, name, (left, place[1] + round(size)), font, scale, INK, 1, cv2.LINE_AA)
    return drawn


def _widened(sheet: Array, width: int) -> Array:
    return np.pad(sheet, ((0, 0), (0, width - sheet.shape[1]), (0, 0)), constant_values=245)
