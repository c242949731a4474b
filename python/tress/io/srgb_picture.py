"""Any Pillow colour mode to 8-bit sRGB and an alpha channel."""

import io
from typing import Any

import numpy as np
from PIL import Image, ImageCms

_TRANSPARENT_MODES = ("RGBA", "RGBa", "LA", "La", "PA")
_DEEP_MODES = ("I", "F", "I;16", "I;16B", "I;16L", "I;16N")
_PROFILED_MODES = ("RGB", "L", "CMYK", "LAB")
_NO_CONVERSION = (ImageCms.PyCMSError, OSError, ValueError, TypeError)


def srgb_picture(picture: Image.Image) -> tuple[Image.Image, Image.Image | None, tuple[str, ...]]:
    """The picture in mode RGB, its alpha in mode L (None without one), and a sentence on what could not be honoured."""
    if picture.mode in _TRANSPARENT_MODES or "transparency" in picture.info:
        colors = picture.convert("RGBA")
        alpha = colors.getchannel("A")
        colors = colors.convert("RGB")
    else:
        alpha = None
        colors = _eight_bit(picture)
    rgb, notes = _without_profile(colors, picture.info.get("icc_profile"))
    return rgb, alpha, notes


def _eight_bit(picture: Image.Image) -> Image.Image:
    """The picture with 8 bits a channel, in a mode that colour profiles know."""
    if picture.mode in _DEEP_MODES:
        return Image.fromarray(_eight_bit_grey(np.asarray(picture)))
    if picture.mode in _PROFILED_MODES:
        return picture
    return picture.convert("L" if picture.mode == "1" else "RGB")


def _eight_bit_grey(values: np.ndarray) -> np.ndarray:
    """Deep grey values as uint8, by the smallest usual full scale that holds them; 16-bit types are always 65535."""
    deep = np.nan_to_num(values.astype(np.float64))
    scales = (65535.0,) if values.dtype.itemsize == 2 else (1.0, 255.0, 65535.0)
    full_scale = next((scale for scale in scales if deep.max() <= scale), deep.max())
    return np.rint(np.clip(deep, 0, None) * (255 / full_scale)).astype(np.uint8)


def _without_profile(picture: Image.Image, profile: bytes | None) -> tuple[Image.Image, tuple[str, ...]]:
    """The picture in sRGB, by its embedded profile where it has a usable one."""
    if picture.mode == "LAB":
        return _converted(picture, ImageCms.createProfile("LAB")), ()
    if not profile:
        return picture.convert("RGB"), ()
    try:
        return _converted(picture, ImageCms.ImageCmsProfile(io.BytesIO(profile))), ()
    except _NO_CONVERSION:
        note = "The embedded colour profile cannot be used; the values were taken to be sRGB."
        return picture.convert("RGB"), (note,)


def _converted(picture: Image.Image, profile: Any) -> Image.Image:
    converted = ImageCms.profileToProfile(
        picture,
        profile,
        ImageCms.createProfile("sRGB"),
        renderingIntent=ImageCms.Intent.RELATIVE_COLORIMETRIC,
        outputMode="RGB",
    )
    assert converted is not None  # only in-place conversion returns nothing
    return converted
