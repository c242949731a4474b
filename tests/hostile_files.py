"""Picture files that a reader must refuse or bear, made from scratch."""

import struct
import zlib
from pathlib import Path

import numpy as np
from PIL import Image, ImageCms


def png_header(path: Path, *, width: int, height: int) -> Path:
    """A PNG that claims a size and holds next to nothing: a decompression bomb's header."""
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = [(b"IHDR", header), (b"IDAT", zlib.compress(b"\0" * 64)), (b"IEND", b"")]
    body = b"".join(_chunk(kind, data) for kind, data in chunks)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + body)
    return path


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def truncated_jpeg(path: Path, picture: Image.Image) -> Path:
    """The first half of a JPEG."""
    picture.save(path, "JPEG", quality=90)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    return path


def save_cmyk(path: Path, picture: Image.Image) -> Path:
    """The picture as a CMYK TIFF."""
    picture.convert("CMYK").save(path, "TIFF")
    return path


def save_deep(path: Path, picture: Image.Image) -> Path:
    """The picture as 16-bit greyscale."""
    grey = np.asarray(picture.convert("L"), np.uint16) * 257
    Image.fromarray(grey).save(path)
    return path


def save_grey(path: Path, picture: Image.Image) -> Path:
    """The picture as 8-bit greyscale."""
    picture.convert("L").save(path)
    return path


def save_palette(path: Path, picture: Image.Image) -> Path:
    """The picture with 256 colours."""
    picture.quantize(256).save(path)
    return path


def save_alpha(path: Path, picture: Image.Image) -> Path:
    """The picture with its outermost twentieth transparent."""
    alpha = np.zeros((picture.height, picture.width), np.uint8)
    margin = min(alpha.shape) // 20
    alpha[margin:-margin, margin:-margin] = 255
    rgba = np.dstack([np.asarray(picture), alpha])
    Image.fromarray(rgba).save(path)
    return path


def save_turned(path: Path, picture: Image.Image) -> Path:
    """The picture stored lying on its side, with the EXIF orientation that puts it upright."""
    exif = Image.Exif()
    exif[0x0112] = 6
    picture.transpose(Image.Transpose.ROTATE_90).save(path, "JPEG", quality=95, exif=exif)
    return path


def save_wide_gamut(path: Path, picture: Image.Image) -> Path:
    """The picture with a linear-light copy of the sRGB profile: wrong by a lot where the profile is ignored."""
    linear = np.asarray(picture, np.float64) / 255
    linear = np.where(linear <= 0.04045, linear / 12.92, ((linear + 0.055) / 1.055) ** 2.4)
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB"))
    Image.fromarray(np.rint(linear * 255).astype(np.uint8)).save(path, icc_profile=_with_linear_curves(profile))
    return path


def _with_linear_curves(profile: ImageCms.ImageCmsProfile) -> bytes:
    """The profile with every tone curve replaced by the identity (a `curv` of no entries)."""
    data = bytearray(profile.tobytes())
    count = struct.unpack(">I", data[128:132])[0]
    for tag in range(count):
        name, offset, size = struct.unpack(">4sII", data[132 + 12 * tag : 144 + 12 * tag])
        if name in (b"rTRC", b"gTRC", b"bTRC"):
            data[offset : offset + size] = b"curv" + bytes(size - 4)
    return bytes(data)
