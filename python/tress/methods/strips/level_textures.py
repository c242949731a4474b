"""The atlases of a level of detail, in the resolution that suits its distance."""

from collections.abc import Mapping, Sequence

import numpy as np

from tress.base.errors import InputError
from tress.base.report import Report
from tress.model.atlas import Atlas
from tress.model.document import Document
from tress.render.textures.mip_chain import mip_chain


def level_atlases(
    document: Document, *, takeover_m: Sequence[float], padding: int, threshold: float, report: Report
) -> list[Mapping[str, Atlas]]:
    """For every level the atlases by name: whole for the first, then halved with every doubling of the distance.

    Distances count from half of that at which the second level takes over. Smaller pictures keep the area that passes
    the alpha test (see `mip_chain`). An atlas that cannot be made smaller, because its regions lie closer than
    `padding`, stays as it is, and the report says so.
    """
    halvings = [0, *(1 + int(np.floor(np.log2(distance / takeover_m[0]) + 0.01)) for distance in takeover_m)]
    levels: list[dict[str, Atlas]] = [{} for _ in halvings]
    for name, atlas in document.of_type(Atlas).items():
        try:
            chain = [mip.atlas for mip in mip_chain(atlas, padding=padding, threshold=threshold)]
        except InputError as error:
            report.warn(f"the atlas {name!r} keeps its resolution on all levels: {error}")
            chain = [atlas]
        for level, halved in zip(levels, halvings, strict=True):
            level[name] = chain[min(halved, len(chain) - 1)]
    return list(levels)
