"""The picture of the stage `volume`: its three depth maps, and slices through the directions."""

import cv2
import numpy as np
from numpy.typing import NDArray

from tress.methods.portrait.pictures import depth_colors
from tress.methods.portrait.volume import HairVolume

ZOOM = 4


def volume_picture(volume: HairVolume) -> NDArray[np.uint8]:
    """Front, mid and back depth beside each other (far violet, near yellow); below, the directions in a level slice, an
    upright slice from the side and the middle layer (x red, y green, z blue, grey: none). (H, W, 3) uint8 sRGB.
    """
    box = volume.box
    above = np.hstack([_depth(values) for values in (volume.front, volume.mid, volume.back)])
    row, column = box.rows // 3, box.columns // 2
    directions = volume.direction
    slices = [directions[:, row], directions[:, :, column].transpose(1, 0, 2), directions[box.layers // 2]]
    shown = [_framed(_direction(slice_), above.shape[1] // 3) for slice_ in slices]
    height = max(picture.shape[0] for picture in shown)
    below = np.hstack([np.pad(p, ((0, height - p.shape[0]), (0, 0), (0, 0))) for p in shown])
    both = np.vstack([above, below])
    return cv2.resize(both, None, fx=ZOOM, fy=ZOOM, interpolation=cv2.INTER_NEAREST).astype(np.uint8)


def _depth(values: NDArray[np.floating]) -> NDArray[np.uint8]:
    picture = depth_colors(values.ravel()).reshape(*values.shape, 3).copy()
    picture[~np.isfinite(values)] = 0
    return picture


def _direction(slice_: NDArray[np.floating]) -> NDArray[np.uint8]:
    return (127.5 + 127.5 * slice_).astype(np.uint8)


def _framed(picture: NDArray[np.uint8], width: int) -> NDArray[np.uint8]:
    kept = picture[:, :width]
    return np.pad(kept, ((0, 0), (0, width - kept.shape[1]), (0, 0)))
