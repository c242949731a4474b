"""Values under zero alpha, so that filters which look past the edge of a strand find hair and no black."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.ndimage import distance_transform_edt

Array = np.ndarray[Any, Any]


def dilated(maps: Mapping[str, Array], *, alpha: Array) -> dict[str, Array]:
    """`maps` (H, W, ...) with every value where `alpha` (H, W) is 0 taken from the nearest pixel where it is not.

    Pixels above 0 keep their values; where alpha is 0 everywhere, all do. Exact Euclidean distances; of several
    nearest pixels one is taken.
    """
    if not alpha.any():
        return dict(maps)
    nearest: Any = distance_transform_edt(alpha == 0, return_distances=False, return_indices=True)
    rows, columns = nearest
    return {name: values[rows, columns] for name, values in maps.items()}
