"""An atlas as pictures that any program opens: one PNG a map."""

from pathlib import Path

from PIL import Image

from tress.base.errors import InputError
from tress.model.atlas import Atlas


def write_atlas_pictures(atlas: Atlas, folder: Path, *, suffix: str = "") -> dict[str, Path]:
    """Writes `color.png` (RGBA, straight alpha), `alpha.png` and a PNG for every map into `folder`, which exists.

    `suffix` comes after the map's name. Maps must be uint8, grey (H, W) or with 3 or 4 channels. Colours under zero
    alpha are written as they are. Returns the files by map. Raises `InputError` for other maps, and `OSError`.
    """
    written = {}
    for name, pixels in {"color": atlas.color, "alpha": atlas.color[..., 3], **atlas.maps}.items():
        if pixels.dtype.name != "uint8" or pixels.shape[2:] not in ((), (3,), (4,)):
            raise InputError(f"Atlas.maps[{name!r}] is {pixels.dtype} {pixels.shape}; a picture of bytes was expected.")
        written[name] = folder / f"{name}{suffix}.png"
        Image.fromarray(pixels).save(written[name], compress_level=6)
    return written
