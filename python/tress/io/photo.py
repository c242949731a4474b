"""Photographs in: any common picture file to 8-bit sRGB, upright, at a working size."""

import struct
import warnings
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageOps

from tress.base.errors import InputError
from tress.io.srgb_picture import srgb_picture

# Pillow also opens PostScript (by running another program) and dozens of formats that no camera writes.
FORMATS = ("JPEG", "MPO", "PNG", "WEBP", "TIFF", "GIF", "BMP", "PPM", "JPEG2000", "TGA", "AVIF")
SMALLEST_SIDE_PX = 64
NEUTRAL_GREY = 128
_READABLE = "a JPEG, PNG, WebP or TIFF picture"
_HEIF_BRANDS = (b"heic", b"heix", b"hevc", b"heim", b"heis", b"mif1", b"msf1")
_DECODING_FAILURES = (OSError, SyntaxError, ValueError, EOFError, KeyError, IndexError, struct.error, zlib.error)


@dataclass(frozen=True)
class Photo:
    """A photograph as the stages read it.

    `pixels` (H, W, 3) uint8 sRGB, upright, transparent parts over neutral grey; `alpha` (H, W) uint8 or None where the
    file is opaque (a cut-out: a hint at where the person is); the file it came from; its size in pixels before
    it was made smaller; `warnings`, one sentence each, on what could not be honoured.
    """

    pixels: np.ndarray
    alpha: np.ndarray | None
    path: Path
    original_width: int
    original_height: int
    warnings: tuple[str, ...] = ()


def read_photo(path: Path | str, *, max_size: int = 1200, max_pixels: int = 120_000_000) -> Photo:
    """The picture in the file `path` as upright 8-bit sRGB, at most `max_size` pixels on its longer side.

    Reads greyscale, palette, CMYK, 16-bit and transparent pictures; turns them upright by their EXIF orientation;
    converts by the embedded colour profile; takes the first frame of an animation. A picture of more than
    `max_pixels` pixels is refused from its header, before memory is asked for. Making smaller averages
    areas of encoded values, as picture editors do.

    Raises `InputError` where the file cannot be read or shows less than 64 pixels a side.

    Limits: no HEIC and no camera raw files; Pillow's own ceiling of 179 million pixels holds above `max_pixels`.
    """
    path = Path(path)
    _check_file(path)
    picture = _decoded(path, max_pixels=max_pixels)
    original_width, original_height = picture.size
    srgb, alpha, notes = srgb_picture(picture)
    srgb, alpha = _composited(srgb, alpha)
    size = _working_size(picture.size, max_size=max_size)
    _check_size(path, picture.size, size)
    return Photo(
        pixels=np.array(_resized(srgb, size)),
        alpha=None if alpha is None else np.array(_resized(alpha, size)),
        path=path,
        original_width=original_width,
        original_height=original_height,
        warnings=notes,
    )


def _check_file(path: Path) -> None:
    try:
        if path.is_dir():
            raise InputError(f"{path} is a folder; name {_READABLE}.")
        with path.open("rb") as file:
            head = file.read(32)
    except FileNotFoundError:
        raise InputError(f"{path} does not exist; name {_READABLE}.") from None
    except OSError as error:
        raise InputError(f"{path} cannot be opened ({error.strerror}); name {_READABLE} that you may read.") from None
    if not head:
        raise InputError(f"{path} is empty; {_READABLE} was expected.")
    if head[4:8] == b"ftyp" and head[8:12] in _HEIF_BRANDS:
        raise InputError(f"{path} is a HEIC picture, which is not read here; export it as JPEG or PNG first.")


def _decoded(path: Path, *, max_pixels: int) -> Image.Image:
    """The first frame, decoded and upright."""
    picture = _opened(path, max_pixels=max_pixels)
    try:
        picture.load()
    except _DECODING_FAILURES as error:
        raise InputError(
            f"{path} is damaged or cut off ({_reason(error)}); save or download the picture again."
        ) from None
    try:
        return ImageOps.exif_transpose(picture)
    except _DECODING_FAILURES:  # a broken EXIF block says nothing about the orientation
        return picture


def _opened(path: Path, *, max_pixels: int) -> Image.Image:
    """The file with its header read; no pixel is decoded yet."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            picture = Image.open(path, formats=_known_formats())
    except Image.DecompressionBombError:
        raise _too_many_pixels(path, "more than 179 million", max_pixels) from None
    except _DECODING_FAILURES:
        raise InputError(f"{path} is not a picture that can be read; {_READABLE} was expected.") from None
    width, height = picture.size
    if width * height > max_pixels:
        picture.close()
        raise _too_many_pixels(path, f"{width}×{height}", max_pixels)
    return picture


def _known_formats() -> list[str]:
    Image.init()
    return [name for name in FORMATS if name in Image.OPEN]


def _too_many_pixels(path: Path, found: str, max_pixels: int) -> InputError:
    return InputError(
        f"{path} claims {found} pixels; at most {max_pixels / 1e6:g} million are read, so make it smaller first."
    )


def _reason(error: Exception) -> str:
    return str(error).splitlines()[0].rstrip(".") if str(error) else type(error).__name__


def _composited(srgb: Image.Image, alpha: Image.Image | None) -> tuple[Image.Image, Image.Image | None]:
    """The picture over neutral grey, blended as encoded: so whoever cut it out saw it."""
    if alpha is None or alpha.getextrema() == (255, 255):
        return srgb, None
    background = Image.new("RGB", srgb.size, (NEUTRAL_GREY,) * 3)
    return Image.composite(srgb, background, alpha), alpha


def _working_size(size: tuple[int, int], *, max_size: int) -> tuple[int, int]:
    scale = min(1.0, max_size / max(size))
    return max(1, round(size[0] * scale)), max(1, round(size[1] * scale))


def _check_size(path: Path, original: tuple[int, int], size: tuple[int, int]) -> None:
    if min(size) < SMALLEST_SIDE_PX:
        shrunk = "" if size == original else f" and {size[0]}×{size[1]} after --max-size"
        raise InputError(
            f"{path} is {original[0]}×{original[1]} pixels{shrunk}; "
            f"a face needs at least {SMALLEST_SIDE_PX} a side, so use a larger picture."
        )


def _resized(picture: Image.Image, size: tuple[int, int]) -> Image.Image:
    return picture if picture.size == size else picture.resize(size, Image.Resampling.BOX)
