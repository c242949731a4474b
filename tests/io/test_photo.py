"""Every kind of picture file becomes upright 8-bit sRGB, or is refused in one sentence that says what to do."""

from pathlib import Path

import numpy as np
import pytest
from hostile_files import (
    png_header,
    save_alpha,
    save_cmyk,
    save_deep,
    save_grey,
    save_palette,
    save_turned,
    save_wide_gamut,
    truncated_jpeg,
)
from PIL import Image

from tress.base.errors import InputError
from tress.io.photo import NEUTRAL_GREY, read_photo


@pytest.fixture
def picture() -> Image.Image:
    """Smooth and lop-sided: red grows to the right, green downwards, 96 x 128 px (high)."""
    y, x = np.mgrid[0:128, 0:96]
    return Image.fromarray(np.dstack([x * 2 + 30, y + 50, (x + y) // 2 + 40]).astype(np.uint8))


def pixels_of(picture: Image.Image) -> np.ndarray:
    return np.asarray(picture)


@pytest.mark.parametrize(
    ("save", "ending", "tolerance"),
    [
        (save_cmyk, "tif", 1),
        (save_palette, "png", 24),
        (save_turned, "jpg", 12),
        (save_wide_gamut, "png", 3),
        (lambda path, picture: picture.save(path, lossless=True) or path, "webp", 0),
        (lambda path, picture: picture.save(path) or path, "bmp", 0),
    ],
)
def test_colour_files_show_the_same_picture(tmp_path, picture, save, ending, tolerance):
    path = save(tmp_path / f"photo.{ending}", picture)
    photo = read_photo(path)
    assert photo.pixels.dtype == np.uint8
    assert photo.alpha is None
    difference = np.abs(photo.pixels.astype(int) - pixels_of(picture))
    assert np.percentile(difference, 99) <= tolerance


@pytest.mark.parametrize("save", [save_grey, save_deep])
def test_grey_files_have_three_equal_channels(tmp_path, picture, save):
    photo = read_photo(save(tmp_path / "photo.png", picture))
    grey = pixels_of(picture.convert("L"))
    assert np.array_equal(photo.pixels, np.repeat(grey[..., None], 3, axis=2))


def test_sixteen_bit_colour_tiff_keeps_its_upper_bytes(tmp_path, picture):
    import cv2

    deep = pixels_of(picture).astype(np.uint16) * 257
    cv2.imwrite(str(tmp_path / "photo.tif"), deep[..., ::-1], [cv2.IMWRITE_TIFF_COMPRESSION, 1])
    assert np.array_equal(read_photo(tmp_path / "photo.tif").pixels, pixels_of(picture))


def test_float_grey_up_to_one_is_full_scale(tmp_path):
    values = np.linspace(0, 1, 64 * 64, dtype=np.float32).reshape(64, 64)
    Image.fromarray(values).save(tmp_path / "photo.tif")
    assert np.array_equal(read_photo(tmp_path / "photo.tif").pixels[..., 0], np.rint(values * 255))


def test_transparent_parts_show_neutral_grey(tmp_path, picture):
    photo = read_photo(save_alpha(tmp_path / "photo.png", picture))
    assert photo.alpha is not None
    assert (photo.pixels[photo.alpha == 0] == NEUTRAL_GREY).all()
    assert np.array_equal(photo.pixels[photo.alpha == 255], pixels_of(picture)[photo.alpha == 255])


def test_palette_transparency_counts(tmp_path, picture):
    palette = picture.quantize(16)
    palette.save(tmp_path / "photo.gif", transparency=palette.getpixel((0, 0)))
    photo = read_photo(tmp_path / "photo.gif")
    assert photo.alpha is not None
    assert photo.alpha[0, 0] == 0


def test_animation_gives_its_first_frame(tmp_path, picture):
    black = Image.new("RGB", picture.size)
    black.save(tmp_path / "photo.gif", save_all=True, append_images=[picture])
    assert not read_photo(tmp_path / "photo.gif").pixels.any()


def test_broken_colour_profile_is_noted_and_passed_over(tmp_path, picture):
    picture.save(tmp_path / "photo.png", icc_profile=b"no profile at all" * 10)
    photo = read_photo(tmp_path / "photo.png")
    assert np.array_equal(photo.pixels, pixels_of(picture))
    assert "profile" in photo.warnings[0]


def test_longer_side_shrinks_to_max_size_by_areas(tmp_path, picture):
    picture.save(tmp_path / "photo.png")
    photo = read_photo(tmp_path / "photo.png", max_size=64 * 2 * 128 // 192)  # 85 px
    assert photo.pixels.shape == (85, 64, 3)
    assert (photo.original_width, photo.original_height) == (96, 128)
    assert abs(photo.pixels.mean() - pixels_of(picture).mean()) < 0.5


def test_halving_averages_four_pixels(tmp_path):
    checks = np.indices((128, 128)).sum(axis=0) % 2 * 200
    Image.fromarray(checks.astype(np.uint8)).save(tmp_path / "photo.png")
    assert (read_photo(tmp_path / "photo.png", max_size=64).pixels == 100).all()


def write(path: Path, content: bytes) -> Path:
    path.write_bytes(content)
    return path


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda folder, picture: folder / "absent.jpg", "does not exist"),
        (lambda folder, picture: folder, "is a folder"),
        (lambda folder, picture: write(folder / "a.jpg", b""), "is empty"),
        (lambda folder, picture: write(folder / "a.jpg", b"Dear diary, today I was a picture."), "not a picture"),
        (lambda folder, picture: write(folder / "a.heic", b"\0\0\0\x18ftypheic" + bytes(64)), "HEIC"),
        (lambda folder, picture: write(folder / "a.png", b"\x89PNG\r\n\x1a\n"), "not a picture"),
        (lambda folder, picture: truncated_jpeg(folder / "a.jpg", picture), "damaged or cut off"),
        (lambda folder, picture: png_header(folder / "a.png", width=20_000, height=20_000), "million"),
        (lambda folder, picture: png_header(folder / "a.png", width=12_000, height=12_000), "12000×12000"),
        (lambda folder, picture: png_header(folder / "a.png", width=200, height=200), "damaged or cut off"),
        (lambda folder, picture: save_grey(folder / "a.png", picture.resize((1, 1))), "is 1×1 pixels"),
        (lambda folder, picture: save_grey(folder / "a.png", picture.resize((3000, 70))), "after --max-size"),
    ],
)
def test_unusable_files_are_refused_in_one_sentence(tmp_path, picture, make, message):
    with pytest.raises(InputError, match=message) as caught:
        read_photo(make(tmp_path, picture))
    assert "\n" not in str(caught.value)
    assert str(caught.value).endswith(".")


@pytest.mark.parametrize("seed", range(20))
def test_flipped_bytes_never_escape_as_other_errors(tmp_path, picture, seed):
    picture.save(tmp_path / "a.jpg", quality=80)
    data = bytearray((tmp_path / "a.jpg").read_bytes())
    random = np.random.default_rng(seed)
    for place in random.integers(2, len(data), 12):
        data[place] = random.integers(256)
    try:
        photo = read_photo(write(tmp_path / "b.jpg", bytes(data)))
    except InputError:
        return
    assert photo.pixels.shape[2] == 3
