"""Where a turned crop takes its pixels from."""

import numpy as np
import pytest

from tress.head.crop import Crop


@pytest.mark.parametrize("angle", [0.0, 0.4, -1.2])
@pytest.mark.parametrize("size", [24.0, 40.0, 150.0])
def test_a_crop_of_a_ramp_is_the_ramp_at_the_places_it_names(angle: float, size: float) -> None:
    rows, columns = np.mgrid[0:200, 0:240] + 0.5
    image = np.stack([columns, rows, np.zeros_like(rows)], axis=-1).astype(np.uint8)
    crop = Crop((120.0, 100.0), size, angle)
    pixels = crop.pixels(image, side=32).astype(float)
    y, x = (np.mgrid[0:32, 0:32] + 0.5) / 32
    places = crop.to_image(np.stack([x, y], axis=-1).reshape(-1, 2)).reshape(32, 32, 2)
    inside = ((places > 3) & (places < [237, 197])).all(axis=-1)
    assert np.abs(pixels[..., :2] - (places - 0.5))[inside].max() < 1.6


def test_outside_the_picture_a_crop_is_black() -> None:
    image = np.full((20, 20, 3), 255, np.uint8)
    assert Crop((-50.0, -50.0), 10.0, 0.0).pixels(image, side=8).max() == 0
