"""Pictures of strands that strips are covered with."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.errors import InputError
from tress.model.record import Record, array, attributes

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Atlas(Record):
    """A picture with R regions, one for each variation of strands; a strip is covered with one of them.

    `color` is sRGB with straight alpha, the top row first. A region is (u low, v low, u high, v high) in texture
    coordinates (u to the right, v UP, see `Texture`): the root of a strip lies on its upper edge, the tip on its lower
    one, and the first column of control points on its left edge. `maps` holds further pictures of the same size by name
    (`normal`, `flow`, `depth`, `root_to_tip`, `strand_id` …), (H, W) or (H, W, C), in the dtype of their maker.
    Raises `InputError` for regions outside the picture or without area, and for maps of another size.
    """

    color: Array = array("u1", "H", "W", 4, doc="sRGB and straight alpha, the top row first.")
    regions: Array = array("f4", "R", 4, doc="Texture coordinates: u low, v low, u high, v high.")
    maps: Mapping[str, Array] = attributes("H", doc="Further pictures of the same size by name.")

    def check(self) -> None:
        """Pixels, at least one region, regions within the picture, maps of its size."""
        height, width = self.color.shape[:2]
        if not height * width:
            raise InputError(f"Atlas.color has {height} x {width} pixels; at least one was expected.")
        if not len(self.regions):
            raise InputError("Atlas.regions is empty; at least one region was expected.")
        low, high = self.regions[:, :2], self.regions[:, 2:]
        wrong = ((low < 0) | (high > 1) | (low >= high)).any(axis=1)
        if wrong.any():
            region = int(np.argmax(wrong))
            raise InputError(f"Atlas.regions[{region}] is {self.regions[region]}; 0 <= low < high <= 1 was expected.")
        for name, values in self.maps.items():
            if values.shape[1:2] != (width,):
                raise InputError(f"Atlas.maps[{name!r}] has shape {values.shape}; {height} x {width} was expected.")
